"""The shelter in MuJoCo: slide joints, one-sided spatial tendons, soft contact with a plane."""

import math
import os

os.environ.setdefault("OMP_NUM_THREADS", "1")

import time

import mujoco
import numpy

from scene import FRICTION, GRAVITY, LAUNCH, TIRE_MASS, Outcome, build_scene, launches_by_step
from scene import options_parser, print_json, step_count

RADIUS = 0.1


def build_model(scene, options):
    spec = mujoco.MjSpec()
    spec.option.timestep = options.step
    fall = math.atan(options.slope_percent / 100)
    spec.option.gravity = [0, -GRAVITY * math.sin(fall), -GRAVITY * math.cos(fall)]
    spec.option.cone = getattr(mujoco.mjtCone, "mjCONE_" + options.cone.upper())
    spec.option.solver = getattr(mujoco.mjtSolver, "mjSOL_" + options.solver.upper())
    spec.option.integrator = getattr(mujoco.mjtIntegrator, "mjINT_" + options.integrator.upper())
    spec.option.jacobian = mujoco.mjtJacobian.mjJAC_SPARSE
    spec.option.iterations = options.iterations
    spec.option.tolerance = options.tolerance
    spec.option.impratio = options.impratio
    if not options.warmstart:
        spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_WARMSTART

    world = spec.worldbody
    world.add_geom(name="ground", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0, 0, 1], contype=0, conaffinity=0)
    for number, (x, y) in enumerate(scene.tires):
        body = world.add_body(name=f"tire{number}", pos=[x, y, RADIUS])
        for axis in numpy.eye(3):
            body.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axis)
        body.add_geom(name=f"ball{number}", size=[RADIUS, 0, 0], mass=TIRE_MASS, contype=0, conaffinity=0)
        body.add_site(name=f"tie{number}")
        spec.add_pair(
            geomname1="ground", geomname2=f"ball{number}", condim=3, friction=[FRICTION, FRICTION, 0, 0, 0],
            solref=[options.contact_time * options.step, options.contact_damping],
            solreffriction=[options.friction_time, 1],
            solimp=[options.impedance, options.impedance, 0.001, 0.5, 2],
        )
    if options.tension == "tendon":
        for start, end, length, stiffness in scene.cables:
            tendon = spec.add_tendon(stiffness=stiffness, springlength=[0, length])
            tendon.wrap_site(f"tie{start}")
            tendon.wrap_site(f"tie{end}")
    return spec.compile()


class UserTension:
    """Cable forces worked out with numpy and handed over as joint forces."""

    def __init__(self, scene):
        cables = numpy.array(scene.cables)
        self.starts, self.ends = cables[:, 0].astype(int), cables[:, 1].astype(int)
        self.lengths, self.stiffness = cables[:, 2], cables[:, 3]
        self.rest = numpy.array([(x, y, 0.0) for x, y in scene.tires])

    def apply(self, data):
        """Sets the joint forces of the present positions; returns the greatest tension."""
        positions = self.rest + data.qpos.reshape(-1, 3)
        along = positions[self.ends] - positions[self.starts]
        lengths = numpy.sqrt(numpy.einsum("ij,ij->i", along, along))
        tension = self.stiffness * numpy.maximum(lengths - self.lengths, 0)
        pulls = along * (tension / lengths)[:, None]
        tires = len(self.rest)
        for axis in range(3):
            data.qfrc_applied[axis::3] = numpy.bincount(self.starts, pulls[:, axis], tires)
            data.qfrc_applied[axis::3] -= numpy.bincount(self.ends, pulls[:, axis], tires)
        return tension.max()


def simulate(model, scene, options):
    data = mujoco.MjData(model)
    launches = launches_by_step(scene, options.step)
    user_tension = UserTension(scene) if options.tension == "user" else None
    lengths = numpy.array([cable[2] for cable in scene.cables])
    stiffness = numpy.array([cable[3] for cable in scene.cables])
    launch = LAUNCH + (GRAVITY * options.step / 2 if options.half_step_launch else 0)
    tilt = math.radians(options.tilt)
    height, height_step, force, force_step = 0.0, 0, 0.0, 0

    start = time.perf_counter()
    for step in range(step_count(options)):
        for tire in launches.get(step, ()):
            data.qvel[3 * tire] += launch * math.sin(tilt)
            data.qvel[3 * tire + 2] += launch * math.cos(tilt)
        if user_tension:
            greatest = user_tension.apply(data)
        mujoco.mj_step(model, data)
        if not user_tension:  # lengths of the positions at the start of the step
            greatest = (stiffness * (data.ten_length - lengths)).max()
        if greatest > force:
            force, force_step = greatest, step
        highest = data.qpos[2::3].max()
        if highest > height:
            height, height_step = highest, step + 1
    wall = time.perf_counter() - start
    return Outcome(height, height_step * options.step, force, force_step * options.step, wall)


def main():
    parser = options_parser("MuJoCo")
    parser.add_argument("--tension", choices=["tendon", "user"], default="user")
    parser.add_argument("--cone", choices=["elliptic", "pyramidal"], default="elliptic")
    parser.add_argument("--solver", choices=["newton", "cg", "pgs"], default="newton")
    parser.add_argument("--integrator", choices=["euler", "implicitfast", "rk4"], default="euler")
    parser.add_argument("--iterations", type=int, default=100)
    parser.add_argument("--tolerance", type=float, default=1e-8)
    parser.add_argument("--impratio", type=float, default=1.0)
    parser.add_argument("--contact-time", type=float, default=2.0, help="solref time constant, in steps")
    parser.add_argument("--contact-damping", type=float, default=10.0, help="solref damping ratio")
    parser.add_argument("--friction-time", type=float, default=0.02, help="solreffriction time constant, s")
    parser.add_argument("--impedance", type=float, default=0.9999)
    parser.add_argument("--warmstart", type=int, default=1)
    parser.add_argument("--half-step-launch", type=int, default=0)
    options = parser.parse_args()
    scene = build_scene(options)
    model = build_model(scene, options)
    outcomes = [simulate(model, scene, options) for _ in range(options.repeats)]
    print_json("mujoco", mujoco.__version__, "f64", options, outcomes)


if __name__ == "__main__":
    main()
