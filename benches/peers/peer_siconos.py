"""The shelter in Siconos: point masses, unilateral contact with exact Coulomb friction, Moreau's time stepping.

Runs in the Python that Debian's package python3-siconos is for.
"""

import os

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import subprocess
import time

import numpy
from siconos import kernel, numerics

from scene import FRICTION, GRAVITY, LAUNCH, TIRE_MASS, Outcome, build_scene, launches_by_step
from scene import options_parser, print_json, step_count

# Velocity of a tire in the frame of its contact: normal, then along the ground.
TO_CONTACT = numpy.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])


def build(scene, options):
    """A simulation at rest, and its tires; coordinates are displacements."""
    model = kernel.NonSmoothDynamicalSystem(0.0, 2.0 * options.duration)
    law = kernel.NewtonImpactFrictionNSL(0.0, 0.0, FRICTION, 3)
    tires = []
    for _ in scene.tires:
        tire = kernel.LagrangianLinearTIDS(numpy.zeros(3), numpy.zeros(3), TIRE_MASS * numpy.eye(3))
        tire.setFExtPtr(numpy.array([0.0, 0.0, -TIRE_MASS * GRAVITY]))
        model.insertDynamicalSystem(tire)
        model.link(kernel.Interaction(law, kernel.LagrangianLinearTIR(TO_CONTACT)), tire)
        tires.append(tire)
    contact = kernel.FrictionContact(3, getattr(numerics, "SICONOS_FRICTION_3D_" + options.solver.upper()))
    contact.numericsSolverOptions().dparam[numerics.SICONOS_DPARAM_TOL] = options.tolerance
    contact.setMStorageType(numerics.NM_SPARSE_BLOCK)
    simulation = kernel.TimeStepping(
        model, kernel.TimeDiscretisation(0.0, options.step), kernel.MoreauJeanOSI(1.0), contact
    )
    simulation.setNewtonOptions(kernel.SICONOS_TS_LINEAR)
    simulation.initialize()
    return model, simulation, tires


class Tension:
    """Cable forces worked out with numpy, as the other peers in Python do."""

    def __init__(self, scene):
        cables = numpy.array(scene.cables)
        self.starts, self.ends = cables[:, 0].astype(int), cables[:, 1].astype(int)
        self.lengths, self.stiffness = cables[:, 2], cables[:, 3]
        self.rest = numpy.array([(x, y, 0.0) for x, y in scene.tires])

    def on_tires(self, displacements):
        """Force on each tire, and the greatest tension."""
        positions = self.rest + displacements
        along = positions[self.ends] - positions[self.starts]
        lengths = numpy.sqrt(numpy.einsum("ij,ij->i", along, along))
        tension = self.stiffness * numpy.maximum(lengths - self.lengths, 0)
        pulls = along * (tension / lengths)[:, None]
        forces = numpy.empty_like(self.rest)
        for axis in range(3):
            forces[:, axis] = numpy.bincount(self.starts, pulls[:, axis], len(forces))
            forces[:, axis] -= numpy.bincount(self.ends, pulls[:, axis], len(forces))
        return forces, tension.max()


def simulate(scene, options):
    model, simulation, tires = build(scene, options)
    tension, launches = Tension(scene), launches_by_step(scene, options.step)
    # Velocities are those of the middle of a step.
    launch = LAUNCH + GRAVITY * options.step / 2
    weight = numpy.array([0.0, 0.0, -TIRE_MASS * GRAVITY])
    places, forces_on = [tire.q() for tire in tires], [tire.fExt() for tire in tires]
    height, height_step, force, force_step = 0.0, 0, 0.0, 0

    start = time.process_time()
    for step in range(step_count(options)):
        for tire in launches.get(step, ()):
            tires[tire].velocity()[2] += launch
            tires[tire].swapInMemory()
        forces, greatest = tension.on_tires(numpy.array(places))
        for on_tire, pulls in zip(forces_on, forces + weight):
            on_tire[:] = pulls
        simulation.computeOneStep()
        simulation.nextStep()
        if greatest > force:
            force, force_step = greatest, step
        highest = max(place[2] for place in places)
        if highest > height:
            height, height_step = highest, step + 1
    wall = time.process_time() - start
    return Outcome(height, height_step * options.step, force, force_step * options.step, wall)


def siconos_version():
    listed = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", "python3-siconos"], capture_output=True, text=True)
    return listed.stdout.partition("+")[0]


def main():
    parser = options_parser("Siconos")
    parser.add_argument("--solver", choices=["nsgs", "nsn_ac"], default="nsgs")
    parser.add_argument("--tolerance", type=float, default=1e-4)
    options = parser.parse_args()
    scene = build_scene(options)
    outcomes = [simulate(scene, options) for _ in range(options.repeats)]
    print_json("siconos", siconos_version(), "f64", options, outcomes)


if __name__ == "__main__":
    main()
