"""CPU time to an error, side by side with Mitsuba 3 (pip install mitsuba numpy; its LLVM variant wants libllvm19).

usage: python time_to_error.py PHOTONLAB [SCENE...]        scenes: cornell-box, square-lamp, ball-lens

Mitsuba renders each scene twice, by its path tracer or, where that finds no caustic, by its particle tracer. Both are unbiased: what
the two differ in is their noise, and together they are the reference, whose noise is taken off the error of photonlab's images. The
error is the RMS over pixels and channels over the mean; lamps seen and their neighbours are left out. Times are CPU seconds of
the process, or of the rendering alone for Mitsuba, after a first one that compiles. The time to an error e' is extrapolated by
1 / e^2 from the measured one. In the Cornell box the bias is also that of the pixels within 6 cm of where two walls join, which no box hides. Nothing here is needed to build, run or test the project.
"""
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import mitsuba as mi
import numpy as np

mi.set_variant("llvm_ad_rgb" if "llvm_ad_rgb" in mi.variants() else "scalar_rgb")

SCENES = Path(__file__).resolve().parent.parent / "scenes"
TARGET = 0.02
# Mitsuba's integrator and points per pixel, and photonlab's options.
JOBS = {
    "cornell-box": ({"type": "path", "max_depth": -1}, 512, [
        "--method progressive --photons 4e6 --spp 64",
        "--method progressive --photons 1.4e7 --spp 192",
        "--cache --passes 16 --spp 160 --gather-rays 160",
        "--method final-gather --spp 512",
        "--method path --spp 512",
    ]),
    "square-lamp": ({"type": "path", "max_depth": -1}, 512, [
        "--method progressive --photons 1e6 --direct photons",
        "--method final-gather --spp 256",
    ]),
    "ball-lens": ({"type": "ptracer", "max_depth": -1}, 4096, [
        "--method progressive --photons 1e6",
        "--method progressive --photons 4e6",
        "--method adaptive --photons 1e6",
    ]),
}


def of_children(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def pixels(path):
    bitmap = mi.Bitmap(str(path))
    names = [field.name for field in bitmap.struct_()]
    return np.array(bitmap).astype(float)[:, :, [names.index(channel) for channel in "RGB"]]


def by_mitsuba(scene, integrator, spp):
    mi.render(scene, integrator=integrator, spp=1, seed=99).numpy()
    images, seconds = [], []
    for seed in (0, 1):
        before = resource.getrusage(resource.RUSAGE_SELF)
        images.append(mi.render(scene, integrator=integrator, spp=spp, seed=seed).numpy().astype(float)[:, :, :3])
        after = resource.getrusage(resource.RUSAGE_SELF)
        seconds.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
    return images, np.mean(seconds)


def without_lamps(image, brightest):
    lamp = image.mean(axis=2) > brightest
    near = lamp.copy()
    for down in (-1, 0, 1):
        for across in (-1, 0, 1):
            near |= np.roll(np.roll(lamp, down, 0), across, 1)
    return ~near


def joins(pixels_across):
    """True where a pixel of the Cornell box shows a wall within 6 cm of another, by its camera and its boxes' outlines."""
    half = np.tan(np.radians(39.3077 / 2))
    place = (np.arange(pixels_across) + 0.5) / pixels_across * 2 - 1
    across, up = np.meshgrid(place * half, -place * half)
    # From z = 3.9 along (across, up, -1): the distance along z to the walls, the floor or ceiling and the back.
    far = np.minimum(1 / np.maximum(np.maximum(abs(across), abs(up)), 1e-9), 4.9)
    at = np.stack([across * far, up * far, 3.9 - far], axis=-1)
    inside = far > 2.9
    gaps = np.sort(np.stack([1 - abs(at[..., 0]), 1 - abs(at[..., 1]), at[..., 2] + 1], axis=-1), axis=-1)
    boxes = (abs(across) < 0.21) & (-0.31 < up) & (up < 0.07)
    return inside & (gaps[..., 1] < 0.06) & ~boxes


def report(name, what, error, bias, seconds):
    reach = seconds * (error / TARGET) ** 2
    print(f"{name:12} {what:55} {100 * error:7.3f} % {bias:>18} {seconds:8.2f} s {reach:9.2f} s to {100 * TARGET:.0f} %", flush=True)


def compare(photonlab, name, folder):
    integrator, spp, options = JOBS[name]
    file = SCENES / f"{name}.xml"
    scene = mi.load_file(str(file), optimize=False)
    references, seconds = by_mitsuba(scene, mi.load_dict(integrator), spp)
    reference = np.mean(references, axis=0)
    keep = without_lamps(reference, 20 * reference.mean())
    mean = reference[keep].mean()
    parts = [keep, keep & joins(keep.shape[1])] if name == "cornell-box" else [keep]
    variance = 0.5 * ((references[0] - references[1])[keep] ** 2).mean()
    report(name, f"Mitsuba {mi.__version__} {integrator['type']}, {spp} points", variance**0.5 / mean, "", seconds)
    for option in options:
        images, times = [], []
        for seed in (0, 1):
            out = folder / "image.exr"
            command = [photonlab, "render", str(file), "-o", str(out), "--threads", "1", "--seed", str(seed), *option.split()]
            times.append(of_children(command))
            images.append(pixels(out))
        squared = np.mean([((image - reference)[keep] ** 2).mean() for image in images]) - 0.5 * variance
        image = np.mean(images, axis=0)
        biases = [f"{100 * (image[part].mean() / reference[part].mean() - 1):+.3f} %" for part in parts]
        report(name, f"photonlab {option}", max(squared, 0) ** 0.5 / mean, " ".join(biases), np.mean(times))


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    names = sys.argv[2:] or list(JOBS)
    unknown = [name for name in names if name not in JOBS]
    if unknown:
        sys.exit(f"no such scene: {', '.join(unknown)}; there are {', '.join(JOBS)}")
    print(f"Mitsuba {mi.__version__}, {mi.variant()}, {os.cpu_count()} cores; a column each: error, bias of the mean, CPU time, CPU time to the target")
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            compare(sys.argv[1], name, Path(folder))


if __name__ == "__main__":
    main()
