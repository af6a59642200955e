"""Runs every peer over a range of steps and prints Markdown tables.

    python run.py            speed at a given accuracy, on the 20 x 20 grid; with --every-scene on all four scenes
    python run.py validate   heights and forces of the four scenes, each peer at a fine step
    python run.py effects    the same on a slope and with tilted launches, for the peer that has them
"""

import argparse
import importlib.util
import json
import os
import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path

HERE = Path(__file__).parent
ONE_THREAD = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}


@dataclass
class Case:
    """A scene, the plan of it for shelter, and its reference answers."""

    title: str
    plan: Path
    options: list
    height: float
    force: float
    keys: tuple = ()  # (section or key of the plan, what takes its place)


GRID = Case("20 × 20, rows 6 to 15", HERE / "20x20.toml", [], 1.82570, 26750.4)
SMALL_GRID = Case(
    "5 × 10, rows 2, 3, 4", HERE / "5x10.toml",
    ["--rows", "5", "--columns", "10", "--blast-rows", "2,3,4"], 1.76711, 10016.8,
)
QUINCUNX = Case(
    "quincunx 2 × 2, diagonal 1 m", HERE / "quincunx.toml",
    ["--layout", "quincunx", "--rows", "2", "--columns", "2", "--spacing", "1.4142135623730951",
     "--blast-rows", "1.5", "--axial-stiffness", "1.519e6"], 0.75741, 17735.7,
)
WIDE_QUINCUNX = Case(
    "quincunx 2 × 2, diagonal 2 m", HERE / "quincunx.toml",
    ["--layout", "quincunx", "--rows", "2", "--columns", "2", "--spacing", "2.8284271247461903",
     "--blast-rows", "1.5"], 1.08394, 10015.6,
    keys=(("1.4142135623730951", "2.8284271247461903"), ("axial_stiffness_kn = 1519", "axial_stiffness_kn = 1400")),
)
SCENES = [WIDE_QUINCUNX, QUINCUNX, SMALL_GRID, GRID]
SLOPED = replace(
    SMALL_GRID, title="5 × 10 on a slope of 20 %", options=[*SMALL_GRID.options, "--slope-percent", "20"],
    keys=(("[ground]", "[ground]\nslope_percent = 20\nslope_toward_deg = 270"),), height=1.795402, force=10185.07,
)
TILTED = replace(
    SMALL_GRID, title="5 × 10, launches tilted by 10°", options=[*SMALL_GRID.options, "--tilt", "10"],
    keys=(("under_row", "tilt_deg = 10\nunder_row"),), height=1.730562, force=17957.50,
)


@dataclass
class ErrorClass:
    title: str
    height: float
    force: float

    def admits(self, result):
        return result["height_error"] <= self.height and result["force_error"] <= self.force


ERROR_CLASSES = [ErrorClass("1 % height, 2 % force", 0.01, 0.02), ErrorClass("0.2 % of both", 0.002, 0.002)]


@dataclass
class Peer:
    """A program with its tuned settings: a common part, and one to choose from at every step."""

    title: str
    command: list
    variants: list
    steps_ms: list
    validation_step_ms: float
    validation_settings: list
    missing: str = ""


def python_peer(title, script, module, variants, steps_ms, validation_step_ms, validation_settings):
    missing = "" if importlib.util.find_spec(module) else f"Python module {module} is not installed"
    command = [sys.executable, str(HERE / script)]
    return Peer(title, command, variants, steps_ms, validation_step_ms, validation_settings, missing)


SYSTEM_PYTHON = "/usr/bin/python3"  # the one that packages of Debian are for


def siconos_peer():
    found = subprocess.run([SYSTEM_PYTHON, "-c", "import siconos"], capture_output=True).returncode == 0
    return Peer(
        "Siconos", [SYSTEM_PYTHON, str(HERE / "peer_siconos.py")], [[], ["--tolerance", "1e-8"], ["--solver", "nsn_ac"]],
        divisors_of_delay(2, 3, 4, 5, 8, 10, 14, 20, 40), 0.2, ["--tolerance", "1e-8"],
        "" if found else "Debian's package python3-siconos is not installed",
    )


def rapier_peers():
    binary = Path(os.environ.get("CARGO_TARGET_DIR", HERE / "rapier/target")) / "release/rapier-peer"
    missing = "" if binary.exists() else "rapier-peer is not built"
    variants = [
        ["--half-step-launch", "true"],
        ["--solver-iterations", "2"],
        ["--stabilization-iterations", "1"],
    ]
    return [
        Peer(f"Rapier {precision}", [str(binary), "--precision", precision], variants,
             divisors_of_delay(2, 3, 4, 6, 8, 9, 10, 11, 12, 14, 20, 40), 0.1,
             ["--stabilization-iterations", "1", "--contact-recycling", "false"], missing)
        for precision in ["f32", "f64"]
    ]


def divisors_of_delay(*counts):
    """Steps, in ms, of which a whole number fits into the 20 ms between rows."""
    return [20 / count for count in counts]


def all_peers():
    mujoco_variants = [
        ["--solver", solver, "--friction-time", time, "--contact-damping", damping, "--tolerance", tolerance]
        for solver, time, damping, tolerance in [
            ("newton", "0.08", "1", "1e-4"), ("newton", "0.03", "1", "1e-4"), ("newton", "0.03", "10", "1e-4"),
            ("newton", "0.04", "20", "1e-6"), ("newton", "0.05", "30", "1e-8"),
            ("cg", "0.03", "1", "1e-4"), ("cg", "0.05", "10", "1e-3"),
        ]
    ]
    opensees_steps = divisors_of_delay(4, 5, 8, 10, 14, 20, 40)
    opensees_validation = ["--contact", "impact", "--yielding", "0.2"]
    opensees_variants = [[], ["--contact-stiffness", "1"], ["--contact", "impact"]]
    return [
        *rapier_peers(),
        siconos_peer(),
        python_peer(
            "MuJoCo", "peer_mujoco.py", "mujoco",
            mujoco_variants, divisors_of_delay(3, 4, 5, 8, 10, 14, 20, 40), 0.5, [],
        ),
        python_peer(
            "OpenSees", "peer_opensees.py", "openseespy",
            opensees_variants, opensees_steps, 0.1, opensees_validation,
        ),
        python_peer(
            "OpenSees, peaks of the first 0.75 s", "peer_opensees.py", "openseespy",
            [[*variant, "--peaks-until", "0.75"] for variant in opensees_variants],
            opensees_steps, 0.1, [*opensees_validation, "--peaks-until", "0.75"],
        ),
    ]


def run_peer(peer, case, variant, step_ms, repeats):
    """The JSON of one run, or None when it failed or became unstable."""
    command = [*peer.command, *case.options, *variant, "--step", repr(step_ms / 1000), "--repeats", str(repeats),
               "--reference-height", str(case.height), "--reference-force", str(case.force)]
    done = subprocess.run(command, env=ONE_THREAD, capture_output=True, text=True)
    lines = [line for line in done.stdout.splitlines() if line.startswith("{")]
    return json.loads(lines[-1]) if done.returncode == 0 and lines else None


SHELTER_REPEATS = 200  # take about as long as the five of a peer, so that both meet the same moods of the machine


def run_shelter(binary, case, step_ms, repeats):
    """`shelter check` at a fixed step of a plan with as many equal options as repeats, in the form the peers print."""
    plan = case.plan.read_text()
    for key, text in case.keys:
        plan = plan.replace(key, text)
    for number in range(1, repeats):
        plan += f'\n[[delay]]\nname = "again {number}"\ninterval_ms = 20\n'
    command = [binary, "check", "-", "--nominal", "--dt", repr(step_ms / 1000), "--threads", "1", "--format", "json"]
    done = subprocess.run(command, env=ONE_THREAD, input=plan, capture_output=True, text=True)
    if done.returncode not in (0, 1) or not done.stdout:  # 1: limits are exceeded, which does not matter here
        return None
    options = json.loads(done.stdout)["options"]
    if any("wall_s" not in option for option in options):  # the step is beyond the stability limit
        return None
    walls = [option["wall_s"] for option in options]
    height, force = options[0]["flight_height_m"], options[0]["cable_force_n"]
    return {
        "version": "", "dt_s": options[0]["dt_s"],
        "wall_s": {"min": min(walls), "median": sorted(walls)[len(walls) // 2]},
        "height_m": height["value"], "height_at_s": height["at_s"],
        "force_n": force["value"], "force_at_s": force["at_s"],
        "height_error": abs(height["value"] / case.height - 1),
        "force_error": abs(force["value"] / case.force - 1),
    }


def percent(fraction):
    return f"{100 * fraction:.3f} %"


def print_speed(options, case):
    results = {}
    if options.shelter:
        runs = [run_shelter(options.shelter, case, step, SHELTER_REPEATS)
                for step in divisors_of_delay(2, 2.5, 3, 3.5, 4, 5, 6, 7, 8, 10, 14, 20, 40)]
        results["shelter"] = ([(run, []) for run in runs if run], "no run succeeded")
    for peer in all_peers():
        runs = []
        if not peer.missing:
            for step in peer.steps_ms:
                runs += [(run_peer(peer, case, variant, step, options.repeats), variant) for variant in peer.variants]
                print(f"{case.title}, {peer.title}: {step:.3g} ms done", file=sys.stderr)
        results[peer.title] = ([(run, variant) for run, variant in runs if run], peer.missing)

    if options.all:
        for title, (runs, _) in results.items():
            for run, variant in runs:
                print(f"{title}\t{1e3 * run['dt_s']:.3g} ms\t{1e3 * run['wall_s']['min']:.2f} ms\t"
                      f"{percent(run['height_error'])}\t{percent(run['force_error'])}\t{' '.join(variant)}", file=sys.stderr)

    for error_class in ERROR_CLASSES:
        print_class(case, error_class, results)


def print_class(case, error_class, results):
    print(f"\n{case.title}, fastest within {error_class.title}:\n")
    print("| program | step, ms | wall, ms (min / median) | height error | force error | × shelter "
          "| at every finer step too: step, ms | wall, ms | × shelter | settings |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    own_best = own_steady = None
    for title, (runs, missing) in results.items():
        fitting = [pair for pair in runs if error_class.admits(pair[0])]
        if not fitting:
            print(f"| {title} | {'not run: ' + missing if missing else 'not reached'} | | | | | | | | |")
            continue
        best, variant = fastest(fitting)
        steady, _ = fastest([pair for pair in fitting if holds_at_finer_steps(pair, runs, error_class)])
        if title == "shelter":
            own_best, own_steady = best, steady
        wall = best["wall_s"]
        print(f"| {title} {best['version']} | {milliseconds(best['dt_s'])} "
              f"| {milliseconds(wall['min'])} / {milliseconds(wall['median'])} "
              f"| {percent(best['height_error'])} | {percent(best['force_error'])} | {ratio(best, own_best)} "
              f"| {milliseconds(steady['dt_s']) if steady else 'none'} "
              f"| {milliseconds(steady['wall_s']['min']) if steady else ''} | {ratio(steady, own_steady)} "
              f"| {' '.join(variant)} |")


def fastest(runs):
    return min(runs, key=lambda pair: pair[0]["wall_s"]["min"], default=(None, []))


def holds_at_finer_steps(pair, runs, error_class):
    """Whether no finer step with the same settings is worse than the class: no lucky hit."""
    run, variant = pair
    return all(error_class.admits(other) for other, settings in runs
               if settings == variant and other["dt_s"] < run["dt_s"])


def ratio(run, own):
    return f"{run['wall_s']['min'] / own['wall_s']['min']:.1f}" if run and own else "–"


def milliseconds(seconds):
    value = 1e3 * seconds
    return f"{value:.0f}" if value >= 100 else f"{value:.3g}"


def print_validation(options, cases, titles=None):
    peers = [peer for peer in all_peers() if titles is None or peer.title in titles]
    print("| scene | program | step, ms | height, m | at, s | error | force, N | at, s | error |")
    print("|---|---|---|---|---|---|---|---|---|")
    for case in cases:
        print(f"| {case.title} | reference | | {case.height:.5f} | | | {case.force:.1f} | | |")
        rows = []
        if options.shelter:
            rows.append(("shelter", run_shelter(options.shelter, case, 0.1, 1), "run failed"))
        for peer in peers:
            run = None
            if not peer.missing:
                run = run_peer(peer, case, peer.validation_settings, peer.validation_step_ms, 1)
            rows.append((peer.title, run, peer.missing or "run failed"))
        for title, run, reason in rows:
            if run is None:
                print(f"| | {title} | {reason} | | | | | | |")
                continue
            print(f"| | {title} {run['version']} | {milliseconds(run['dt_s'])} "
                  f"| {run['height_m']:.5f} | {run['height_at_s']:.3f} | {percent(run['height_error'])} "
                  f"| {run['force_n']:.1f} | {run['force_at_s']:.4f} | {percent(run['force_error'])} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", nargs="?", choices=["speed", "validate", "effects"], default="speed")
    parser.add_argument("--shelter", metavar="PATH", help="the shelter binary to compare with")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--every-scene", action="store_true", help="speed on all four scenes")
    parser.add_argument("--all", action="store_true", help="list every run on stderr")
    options = parser.parse_args()
    if options.what == "validate":
        print_validation(options, SCENES)
    elif options.what == "effects":
        print_validation(options, [SLOPED, TILTED], ["MuJoCo"])
    else:
        for case in SCENES if options.every_scene else [GRID]:
            print_speed(options, case)


if __name__ == "__main__":
    main()
