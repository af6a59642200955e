"""The shelter in OpenSees: corotational trusses without compression, penalty contact with the ground."""

import os
import sys

os.environ.setdefault("OMP_NUM_THREADS", "1")

import ctypes
import importlib.util
import math
import tempfile
import time
from pathlib import Path


def preload_bundled_libraries():
    """The Linux wheel brings BLAS and LAPACK along, but its loader does not find them."""
    package = importlib.util.find_spec("openseespylinux")
    if package:
        folder = Path(package.origin).parent / "lib"
        for name in ["libquadmath.so.0", "libgfortran.so.4", "libblas.so.3", "liblapack.so.3"]:
            if (folder / name).exists():
                ctypes.CDLL(str(folder / name), ctypes.RTLD_GLOBAL)


preload_bundled_libraries()
import openseespy.opensees as ops

from scene import FRICTION, GRAVITY, LAUNCH, TIRE_MASS, Outcome, build_scene, launches_by_step
from scene import options_parser, print_json, step_count


def build_model(scene, options):
    """Nodes 1..n are the tires, n+1..2n the ground below them; elements 1..m are the cables."""
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 3)
    tires = len(scene.tires)
    for number, (x, y) in enumerate(scene.tires, start=1):
        ops.node(number, x, y, 0.0)
        ops.mass(number, TIRE_MASS, TIRE_MASS, TIRE_MASS)
        ops.node(tires + number, x, y, 0.0)
        ops.fix(tires + number, 1, 1, 1)

    # Stress of a section of 1 m2 is force: EA in tension, nothing in compression.
    ops.uniaxialMaterial("Elastic", 1, options.axial_stiffness, 0.0, 0.0)
    for number, (start, end, _, _) in enumerate(scene.cables, start=1):
        ops.element("corotTruss", number, start + 1, end + 1, 1.0, 1)

    # The stiffest contact with which the step is stable, or stiffer when implicit.
    stiffness = options.contact_stiffness * TIRE_MASS / options.step**2
    contacts = len(scene.cables)
    for tire in range(1, tires + 1):
        contacts += 1
        if options.contact == "asd":
            ops.element("zeroLengthContactASDimplex", contacts, tires + tire, tire, stiffness, stiffness, FRICTION,
                        "-orient", 0, 0, 1, "-intType", options.implex)
        elif options.contact == "impact":
            ops.element("zeroLengthImpact3D", contacts, tire, tires + tire, 3, 0.0, FRICTION, stiffness, stiffness,
                        options.yielding * stiffness, options.yield_depth, 0.0)
        else:
            ops.element("zeroLengthContact3D", contacts, tire, tires + tire, stiffness, stiffness, FRICTION, 0.0, 3)

    ops.timeSeries("Constant", 1)
    ops.pattern("Plain", 1, 1)
    for tire in range(1, tires + 1):
        ops.load(tire, 0.0, 0.0, -TIRE_MASS * GRAVITY)
    add_launches(scene, options)


def add_launches(scene, options):
    """A launch is a force over the one step around its firing time that brings the momentum."""
    half, edge = options.step / 2, options.step * 1e-6
    for number, (at, launched) in enumerate(scene.shots, start=2):
        times = [-1.0, at - half - edge, at - half, at + half - edge, at + half, 1e9]
        ops.timeSeries("Path", number, "-time", *times, "-values", 0.0, 0.0, 1.0, 1.0, 0.0, 0.0)
        ops.pattern("Plain", number, number)
        for tire in launched:
            ops.load(tire + 1, 0.0, 0.0, TIRE_MASS * LAUNCH / options.step)


def set_analysis(options):
    ops.constraints("Plain")
    ops.numberer("RCM")
    explicit = {
        "central": ("CentralDifference",),
        "explicit": ("ExplicitDifference",),
        "newmark-explicit": ("NewmarkExplicit", options.gamma),
    }
    implicit = {
        "newmark": ("Newmark", options.gamma, (options.gamma + 0.5) ** 2 / 4),
        "hht": ("HHT", 0.7),
        "alpha": ("GeneralizedAlpha", 0.5, 2 / 3),
        "trbdf2": ("TRBDF2",),
    }
    if options.integrator in explicit:
        ops.system("Diagonal")
        ops.algorithm("Linear")
        ops.integrator(*explicit[options.integrator])
    else:
        ops.system(options.system)
        ops.test("NormDispIncr", options.tolerance, options.iterations, 0)
        ops.algorithm(options.algorithm)
        ops.integrator(*implicit[options.integrator])
    ops.analysis("Transient")


def simulate(scene, options, folder):
    build_model(scene, options)
    set_analysis(options)
    heights, forces = folder / "heights", folder / "forces"
    recorders = [
        ops.recorder("EnvelopeNode", "-file", str(heights), "-time",
                     "-nodeRange", 1, len(scene.tires), "-dof", 3, "disp"),
        ops.recorder("EnvelopeElement", "-file", str(forces), "-time",
                     "-eleRange", 1, len(scene.cables), "axialForce"),
    ]
    steps = step_count(options)
    recorded = round(min(options.duration, options.peaks_until) / options.step)

    ops.setTime(-options.step)  # a load at time 0 would never be seen
    start = time.perf_counter()
    failed = ops.analyze(recorded + 1, options.step)
    for recorder in recorders:
        ops.remove("recorder", recorder)
    failed = failed or steps > recorded and ops.analyze(steps - recorded, options.step)
    wall = time.perf_counter() - start
    ops.wipe()
    if failed:
        sys.exit(f"OpenSees did not converge at a step of {options.step} s")
    return Outcome(*greatest(heights), *greatest(forces), wall)


def greatest(envelope):
    """Greatest value and its time; rows are least, greatest, greatest absolute, columns (time, value) pairs."""
    row = [float(word) for word in envelope.read_text().splitlines()[1].split()]
    return max(zip(row[1::2], row[::2]))


def main():
    parser = options_parser("OpenSees")
    parser.add_argument("--integrator", choices=["central", "explicit", "newmark-explicit", "newmark", "hht", "alpha", "trbdf2"], default="explicit")
    parser.add_argument("--peaks-until", type=float, default=math.inf, help="s; the run goes on without recording")
    parser.add_argument("--gamma", type=float, default=0.5, help="of newmark-explicit; above 0.5 it damps")
    parser.add_argument("--contact", choices=["asd", "3d", "impact"], default="3d")
    parser.add_argument("--yielding", type=float, default=0.05, help="stiffness left after yielding, of impact contact")
    parser.add_argument("--yield-depth", type=float, default=1e-5, help="m, of impact contact")
    parser.add_argument("--implex", type=int, default=0)
    parser.add_argument("--contact-stiffness", type=float, default=0.8, help="in tire masses per step squared")
    parser.add_argument("--system", default="UmfPack")
    parser.add_argument("--algorithm", default="Newton")
    parser.add_argument("--tolerance", type=float, default=1e-6)
    parser.add_argument("--iterations", type=int, default=30)
    options = parser.parse_args()
    scene = build_scene(options)
    with tempfile.TemporaryDirectory() as folder:
        outcomes = [simulate(scene, options, Path(folder)) for _ in range(options.repeats)]
    print_json("opensees", ops.version(), "f64", options, outcomes)


if __name__ == "__main__":
    main()
