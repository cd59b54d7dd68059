#!/usr/bin/env python3
"""Tests gpc on this machine's GPU, without Rust and without the repository. `tools/pack-gpu.sh` packs this file with what it runs.

It runs the tests of the passes, each in a process of its own; renders images and compares them with references of another
driver; runs the example hosts, which compare themselves with their own brute force; and measures times by pass. It exits with 1
if anything failed. DIR then holds

    summary.txt             what was printed at the end
    failed.txt              the output of what failed
    junit.xml               every test, image and example
    images/, differences/   the rendered images, and error maps of those that differ
    hosts-*.csv             times and errors of the example `forward`
    gpu-*.csv               times by pass of each scene and method
"""

import argparse
import concurrent.futures
import ctypes
import datetime
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as xml
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent
STAGES = ["tests", "images", "examples", "times"]

# Size of the images that are compared, and the images: name, scenes ("*" for all of them) and options of `gpc`.
IMAGE_SIZE = "480x270"
IMAGES = [
    ("none", "*", "render {scene} --aa none"),
    ("64", "*", "render {scene}"),
    ("1024", "*", "render {scene} --samples 1024"),
    ("shadows", "letters glass foliage", "render {scene} --shadows exact"),
    ("sobol", "fence", "render {scene} --pattern sobol"),
    ("triangle", "fence", "render {scene} --shading triangle"),
    ("sample", "foliage", "render {scene} --shading sample"),
    ("zoom", "letters", "zoom {scene} --center 240,135 --radius 60 --multiplicity 0.4"),
    ("panorama", "fence", "panorama {scene} --projection cubemap"),
]

# Bounds for two drivers. Pixels of one sample at their centre are chosen by the device's rasterizer, which rounds corners to
# its own grid, so that some pixels at edges show another triangle. All other samples are chosen by exact rules. Devices
# filter textures differently.
MOST_RMSE_OF_RASTER = 0.005
MOST_RMSE = 0.001
MOST_OVER_2_CODES_UNTEXTURED = 0

# Scenes of assets/ and methods that are timed; scenes that were packed or named besides are timed too.
TIMED = ["fence", "foliage", "letters", "glass", "checker"]
METHODS = [("none", 1), ("superpixel", 64), ("superpixel", 1024), ("msaa", 8), ("ssaa", 64)]

HOST_SIZES = ["240x135", "480x270", "960x540", "1280x720"]


@dataclass
class Case:
    """Something that passed or failed."""

    suite: str
    name: str
    seconds: float
    failure: str = ""
    output: str = ""
    skipped: bool = False


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("scenes", nargs="*", type=Path, help="more scenes to measure; .gltf or .glb")
    parser.add_argument("--out", type=Path, default=Path("gpu-results"), metavar="DIR", help="default: %(default)s")
    parser.add_argument("--only", default=",".join(STAGES), metavar="STAGE,...", help="default: %(default)s")
    parser.add_argument("--filter", default="", metavar="TEXT", help="only tests whose names contain this text")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), metavar="N", help="processes at once; default: cores")
    parser.add_argument("--limit", type=float, default=120, metavar="S", help="seconds for a test; default: %(default)g")
    parser.add_argument("--size", default="1920x1080", metavar="WxH", help="of images that are timed; default: %(default)s")
    parser.add_argument("--repeat", type=int, default=7, metavar="R", help="timed frames; default: %(default)s")
    parser.add_argument("--cpu", action="store_true", help="accept a driver that computes on the CPU")
    parser.add_argument("--references", action="store_true", help="only render the references, when packing")
    chosen = parser.parse_args()
    chosen.only = chosen.only.split(",")
    unknown = set(chosen.only) - set(STAGES)
    if unknown:
        parser.error(f"no stage {', '.join(sorted(unknown))}; there are {', '.join(STAGES)}")
    for scene in chosen.scenes:
        if not scene.is_file():
            parser.error(f"{scene} is not there")
    return chosen


def loadable(library):
    try:
        ctypes.CDLL(library)
        return True
    except OSError:
        return False


def environment():
    """Environment of all programs. What was packed stands in for a missing loader or layer."""
    variables = dict(os.environ, GPC_ROOT=str(ROOT))
    libraries = ROOT / "libraries"
    if libraries.is_dir():
        # NVIDIA's driver loads libX11.
        if not (loadable("libvulkan.so.1") and loadable("libX11.so.6")):
            paths = [str(libraries), variables.get("LD_LIBRARY_PATH")]
            variables["LD_LIBRARY_PATH"] = ":".join(filter(None, paths))
        folders = ["/usr/share/vulkan/explicit_layer.d", "/etc/vulkan/explicit_layer.d"]
        layer = "VkLayer_khronos_validation.json"
        if "VK_LAYER_PATH" not in variables and not any((Path(folder) / layer).is_file() for folder in folders):
            variables["VK_LAYER_PATH"] = str(libraries)
            # The layer's library is found by name.
            paths = [variables.get("LD_LIBRARY_PATH"), str(libraries / "layer")]
            variables["LD_LIBRARY_PATH"] = ":".join(filter(None, paths))
    return variables


def run(command, variables, limit=None, **options):
    """Runs a program. Returns its exit code (None if it took too long), its output, and the seconds that it took."""
    start = time.monotonic()
    try:
        done = subprocess.run(
            [str(word) for word in command],
            env=variables, timeout=limit, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options,
        )
        code, output = done.returncode, done.stdout
    except subprocess.TimeoutExpired as late:
        code, output = None, late.stdout or b""
    return code, output.decode(errors="replace"), time.monotonic() - start


def why(code, limit):
    if code is None:
        return f"took more than {limit:g} s"
    return f"ended by signal {-code}" if code < 0 else f"exit code {code}"


def read_json(output):
    """The JSON object in a program's output, which may have warnings before and after it."""
    return json.loads(output[output.index("{"): output.rindex("}") + 1])


def at_once(jobs, task, items):
    """Cases that a task makes of items, a few at once. Says at once which ones failed."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        tasks = [pool.submit(task, item) for item in items]
        for done, future in enumerate(concurrent.futures.as_completed(tasks), 1):
            case = future.result()
            if case.failure and not case.skipped:
                print(f"{done} of {len(items)}: FAILED {case.name}: {case.failure}", flush=True)
        return [future.result() for future in tasks]


class Suite:
    def __init__(self, chosen):
        self.chosen = chosen
        self.out = chosen.out.resolve()
        self.out.mkdir(parents=True, exist_ok=True)
        self.variables = environment()
        self.gpc = ROOT / "bin/gpc"
        self.cases = []
        self.said = []
        code, output, _ = run([self.gpc, "devices", "--json"], self.variables)
        try:
            devices = json.loads(output)["devices"]
        except (ValueError, KeyError):
            sys.exit(f"gpc devices: {why(code, 0)}: {output}")
        usable = [device for device in devices if not device["missing"]]
        if not usable:
            sys.exit(f"there is no usable Vulkan device:\n{output}")
        # The order in which `gpc` chooses.
        self.device = min(usable, key=lambda device: device["kind"] in ("cpu", "other"))
        self.on_cpu = self.device["kind"] == "cpu"
        if self.on_cpu and not chosen.cpu and not chosen.references:
            sys.exit(f"there is no GPU, only {self.device['name']}; --cpu accepts it")

    def say(self, line=""):
        print(line, flush=True)
        self.said.append(line)

    def scenes(self):
        """All scenes by name: those of assets/, those that were packed besides, and those of the command line."""
        found = {scene.stem: scene for scene in sorted((ROOT / "assets").glob("*.glb"))}
        found.update(self.further())
        return found

    def further(self):
        packed = [path for kind in ("gltf", "glb") for path in (ROOT / "scenes").glob(f"*/*.{kind}")]
        named = [path.resolve() for path in self.chosen.scenes]
        return {scene.stem: scene for scene in sorted(packed) + named}

    # Tests

    def tests(self):
        binary = ROOT / "bin/gpu-tests"
        code, output, _ = run([binary, "--list", "--format", "terse"], self.variables)
        names = [line[: -len(": test")] for line in output.splitlines() if line.endswith(": test")]
        if code != 0 or not names:
            sys.exit(f"{binary} --list: {why(code, 0)}: {output}")
        names = [name for name in names if self.chosen.filter in name]
        variables = self.variables
        if self.on_cpu:
            # As many tests run at once as there are cores.
            variables = dict({"LP_NUM_THREADS": "1"}, **variables)

        def test(name):
            code, output, seconds = run([binary, "--exact", name, "--nocapture"], variables, self.chosen.limit)
            if "test result: ok. 0 passed; 0 failed; 1 ignored" in output:
                return Case("tests", name, seconds, skipped=True)
            passed = code == 0 and "test result: ok. 1 passed" in output
            failure = "" if passed else why(code, self.chosen.limit)
            return Case("tests", name, seconds, failure, output)

        return at_once(self.chosen.jobs, test, names)

    # Images

    def render(self, folder):
        """Renders all images into a folder. Returns a case for each image by its name."""
        folder.mkdir(parents=True, exist_ok=True)
        scenes = self.scenes()
        wanted = []
        for name, of, command in IMAGES:
            for stem in scenes if of == "*" else of.split():
                if not self.chosen.filter or self.chosen.filter in stem:
                    wanted.append((f"{stem}-{name}.png", command, scenes[stem]))

        def image(item):
            name, command, scene = item
            words = [scene if word == "{scene}" else word for word in command.split()]
            command = [self.gpc, *words, "--size", IMAGE_SIZE, "--quiet", "-o", folder / name]
            code, output, seconds = run(command, self.variables, self.chosen.limit)
            failure = "" if code == 0 and not output else why(code, self.chosen.limit)
            return Case("images", name, seconds, failure, output)

        return {case.name: case for case in at_once(self.chosen.jobs, image, wanted)}

    def images(self):
        rendered = self.out / "images"
        shutil.rmtree(rendered, ignore_errors=True)
        cases = self.render(rendered)
        textured = {}
        for stem, scene in self.scenes().items():
            _, output, _ = run([self.gpc, "info", "--json", scene], self.variables)
            textured[stem] = read_json(output)["textures"] > 0
        differences = self.out / "differences"
        shutil.rmtree(differences, ignore_errors=True)
        code, output, _ = run(
            [self.gpc, "compare", ROOT / "references", rendered, "--json", "--heatmap", differences], self.variables)
        compared = read_json(output)["images"]
        width, height = map(int, IMAGE_SIZE.split("x"))
        self.say(f"{'image':<34}{'rmse':>10}{'dB':>7}{'> 2 codes':>11}{'> 8 codes':>11}   pixels of {width * height}")
        for found in compared:
            case = cases.get(found["name"])
            if case is None or case.failure:
                continue
            if "rmse" not in found:
                case.failure = found["reason"]
                case.skipped = found["status"] == "new"
                continue
            stem, _, name = found["name"][: -len(".png")].rpartition("-")
            bound = MOST_RMSE_OF_RASTER if name == "none" else MOST_RMSE
            if found["rmse"] > bound:
                case.failure = f"its rmse is {found['rmse']:.6f}, above {bound}"
            elif name != "none" and not textured[stem] and found["over_2"] > MOST_OVER_2_CODES_UNTEXTURED:
                case.failure = f"{found['over_2']} pixels differ by more than 2 codes"
            decibels = "equal" if found["psnr"] is None else f"{found['psnr']:.1f}"
            mark = "  FAILED" if case.failure else ""
            self.say(f"{found['name']:<34}{found['rmse']:>10.6f}{decibels:>7}{found['over_2']:>11}{found['over_8']:>11}{mark}")
        return list(cases.values())

    # Examples

    def validated(self):
        """Environment with the validation layer, which writes to standard output."""
        return dict(
            self.variables,
            VK_INSTANCE_LAYERS="VK_LAYER_KHRONOS_validation",
            VK_LAYER_ENABLES="VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT",
        )

    def example(self, name, command, judge):
        code, output, seconds = run(command, self.validated(), 300)
        failure = why(code, 300) if code != 0 else judge(output)
        if not failure and "Validation" in output:
            failure = "the validation layer complains"
        return Case("examples", name, seconds, failure, output)

    def examples(self):
        """The example hosts. The bounds are those of tests/hosts."""
        folder = self.out / "examples"
        folder.mkdir(exist_ok=True)

        def figure(output, name):
            return float(re.search(f"^{re.escape(name)}: (.*)$", output, re.MULTILINE)[1])

        def errors(output, view, bounds):
            brute = figure(output, f"{view}error of brute force")
            for name, bound in bounds.items():
                error = figure(output, f"{view}error of {name}")
                self.say(f"{view}{name}: error {error:.6f}, brute force {brute:.6f}")
                if error > bound * brute:
                    return f"{view}the error of {name} is {error}, above {bound} times that of brute force, {brute}"
            return ""

        def forward(output):
            if " 0 left over" not in output:
                return "a frame was left unfinished"
            if "after two resizes: the same picture" not in output:
                return "the picture is another one after two resizes"
            return errors(output, "", {
                "superpixels": 0.97, "superpixels, samples where brute force has them": 1.2,
                "superpixels, each of these samples shaded": 1.15,
            })

        def visibility(output):
            if output.count(" 0 left over") != 2:
                return "a frame was left unfinished"
            bounds = {
                "superpixels": 0.9, "superpixels, samples where brute force has them": 1.15,
                "superpixels, each of these samples shaded": 1.05,
            }
            return errors(output, "", bounds) or errors(output, "through the lens, ", bounds)

        spirv = ROOT / "examples/forward"
        cases = [
            self.example("forward", [ROOT / "bin/forward", spirv, folder / "forward.ppm"], forward),
            self.example("visibility", [ROOT / "bin/visibility", folder / "visibility.png", folder / "lens.png"], visibility),
        ]
        # On a CPU, brute force of the larger sizes takes minutes.
        sizes = ",".join(HOST_SIZES[:2] if self.on_cpu else HOST_SIZES)
        code, output, seconds = run([ROOT / "bin/forward", spirv, "--sizes", sizes], self.variables, 300)
        cases.append(Case("examples", f"forward {sizes}", seconds, why(code, 300) if code != 0 else "", output))
        if code == 0:
            self.write("hosts", sizes, output)
        return cases

    # Times

    def commands(self):
        """The commands that are timed: the packed one, and an earlier one if it was packed too."""
        return {path.name: path for path in [self.gpc, ROOT / "bin/gpc-before"] if path.is_file()}

    def times(self):
        scenes = self.scenes()
        timed = {stem: scenes[stem] for stem in TIMED}
        timed.update(self.further())
        timed = {stem: scene for stem, scene in timed.items() if self.chosen.filter in stem}
        commands = self.commands()
        rows = {name: [] for name in commands}
        cases = []
        with tempfile.TemporaryDirectory() as cache:
            # The drivers' caches begin empty, so that the first frame shows how long its kernels take to compile.
            variables = dict(self.variables, __GL_SHADER_DISK_CACHE_PATH=cache, MESA_SHADER_CACHE_DIR=cache)
            image = Path(cache) / "image.png"
            for state in ("an empty", "a filled"):
                code, output, seconds = run(
                    [self.gpc, "render", next(iter(timed.values())), "--size", self.chosen.size, "--json", "-o", image], variables, 600)
                case = Case("times", f"first frame with {state} cache", seconds, why(code, 600) if code != 0 else "", output)
                cases.append(case)
                if code == 0:
                    steps = read_json(output)["startup_ms"]
                    self.say(f"{case.name}, {next(iter(timed))}: {steps['frame']:.0f} ms, and {steps['pipelines']:.0f} ms to make pipelines")
            for stem, scene in timed.items():
                for method, samples in METHODS:
                    for name, gpc in commands.items():
                        label = f"{stem}, {method} {samples}" + ("" if gpc == self.gpc else f", {name}")
                        command = [gpc, "render", scene, "--size", self.chosen.size, "--aa", method,
                                   "--repeat", self.chosen.repeat, "--json", "-o", image]
                        command += [] if method == "none" else ["--samples", samples]
                        # Otherwise all rounds but the first have one time together.
                        command += ["--time-rounds"] if method == "superpixel" else []
                        code, output, seconds = run(command, variables, 600)
                        case = Case("times", label, seconds, output=output)
                        cases.append(case)
                        if code == 2 and method == "msaa":
                            case.skipped = True
                        elif code != 0:
                            case.failure = why(code, 600)
                        else:
                            report = read_json(output)
                            self.told(label, report)
                            rows[name].append((stem, method, samples, report))
        for name, reports in rows.items():
            suffix = name[len("gpc"):]
            self.write(f"gpu{suffix}", self.chosen.size, self.passes(reports))
        return cases

    def told(self, label, report):
        passes = dict(report["gpu_ms"])
        total = passes.pop("total")
        added = total - passes.get("raster", 0)
        longest = sorted(passes.items(), key=lambda item: -item[1])[:6]
        named = ", ".join(f"{name} {ms:.3f}" for name, ms in longest)
        self.say(f"{label}: {total:.3f} ms, {added:.3f} of it without raster; {named}")

    def passes(self, reports):
        lines = ["scene,method,samples,frames,superpixel_fraction,pass,gpu_ms_median"]
        for stem, method, samples, report in reports:
            share = report["superpixels"]["fraction"]
            for name, ms in report["gpu_ms"].items():
                lines.append(f"{stem},{method},{samples},{self.chosen.repeat},{share:.4f},{name},{ms:.6f}")
        return "\n".join(lines)

    # Results

    def write(self, kind, size, table):
        """Writes a table with the head that files of docs/bench have."""
        driver = self.device["driver"]
        head = {
            "commit": (ROOT / "commit").read_text().strip(),
            "driver": driver,
            "machine": f"{self.device['name']}, {os.cpu_count()} threads",
            "date": datetime.date.today().isoformat(),
            "size": size,
        }
        lines = [f"# {key}: {value}" for key, value in head.items()]
        name = re.sub(r"[^a-z0-9.]+", "-", driver.lower()).strip("-")
        size = f"-{size}" if "," not in size else ""
        (self.out / f"{kind}-{name}{size}.csv").write_text("\n".join(lines + [table.strip(), ""]))

    def report(self):
        """Writes what is known so far."""
        with open(self.out / "failed.txt", "w") as file:
            for case in self.cases:
                if case.failure and not case.skipped:
                    file.write(f"==== {case.suite}: {case.name}: {case.failure}\n{case.output}\n")
        root = xml.Element("testsuites")
        for suite in STAGES:
            cases = [case for case in self.cases if case.suite == suite]
            if not cases:
                continue
            failed = [case for case in cases if case.failure and not case.skipped]
            skipped = [case for case in cases if case.skipped]
            seconds = sum(case.seconds for case in cases)
            element = xml.SubElement(
                root, "testsuite", name=suite, tests=str(len(cases)), failures=str(len(failed)), skipped=str(len(skipped)),
                errors="0", time=f"{seconds:.3f}")
            for case in cases:
                of = xml.SubElement(element, "testcase", classname=suite, name=case.name, time=f"{case.seconds:.3f}")
                if case.skipped:
                    xml.SubElement(of, "skipped")
                elif case.failure:
                    # XML has no control characters.
                    text = re.sub(r"[^\t\n\x20-\ud7ff\ue000-\ufffd]", "?", case.output)
                    xml.SubElement(of, "failure", message=case.failure).text = text
        xml.ElementTree(root).write(self.out / "junit.xml", encoding="utf-8", xml_declaration=True)

    def finish(self, seconds):
        failed = [case for case in self.cases if case.failure and not case.skipped]
        self.say()
        for case in failed:
            panic = re.search(r"panicked at .*(?:\n(?!note:|stack backtrace:|test result).*){0,3}", case.output)
            self.say(f"FAILED {case.suite}: {case.name}: {case.failure}")
            if panic:
                self.say("    " + panic[0][:600].replace("\n", "\n    "))
        for suite in STAGES:
            cases = [case for case in self.cases if case.suite == suite]
            if cases:
                bad, left = (sum(1 for case in cases if test(case)) for test in (
                    lambda case: case.failure and not case.skipped, lambda case: case.skipped))
                longest = max(cases, key=lambda case: case.seconds)
                self.say(
                    f"{suite}: {len(cases) - bad - left} passed, {bad} failed, {left} skipped; "
                    f"longest {longest.seconds:.1f} s, median {statistics.median(case.seconds for case in cases):.1f} s")
        processors = os.times()
        self.say(f"{seconds:.0f} s by the clock, {processors.children_user + processors.children_system:.0f} s of processors")
        (self.out / "summary.txt").write_text("\n".join(self.said) + "\n")
        return 1 if failed else 0


def main():
    start = time.monotonic()
    chosen = arguments()
    suite = Suite(chosen)
    if chosen.references:
        failed = [case for case in suite.render(ROOT / "references").values() if case.failure]
        for case in failed:
            print(f"{case.name}: {case.failure}: {case.output}", file=sys.stderr)
        return 1 if failed else 0
    suite.say(f"{suite.device['name']}, {suite.device['driver']}; gpc of commit {(ROOT / 'commit').read_text().strip()}")
    for stage in STAGES:
        if stage in chosen.only:
            begun = time.monotonic()
            suite.say(f"\n== {stage}")
            suite.cases += getattr(suite, stage)()
            suite.say(f"{time.monotonic() - begun:.0f} s")
            suite.report()
    return suite.finish(time.monotonic() - start)


if __name__ == "__main__":
    sys.exit(main())
