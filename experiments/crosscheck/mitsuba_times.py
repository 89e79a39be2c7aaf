"""What Mitsuba 3 reads of a scene's sensors, and in how many CPU seconds (pip install mitsuba numpy; its LLVM variant wants libllvm19).

usage: python mitsuba_times.py SCENE SECONDS SEEDS

One line of JSON a run, by the file's integrator with more and more points until the runs of one number take so many CPU seconds: the peer's name, the
CPU seconds of rendering all sensors (not of loading nor, by a run before, of compiling), and what each sensor reads in each channel. The
experiment speed-accuracy calls it where Mitsuba is installed.
"""
import json
import os
import resource
import sys

if hasattr(os, "sched_setaffinity"):
    # Its threads wait for each other where a process may use but one core.
    os.sched_setaffinity(0, range(os.cpu_count()))

import mitsuba as mi
import numpy as np

LLVM = "llvm_ad_rgb"
mi.set_variant(LLVM if LLVM in mi.variants() else "scalar_rgb")
mi.set_log_level(mi.LogLevel.Error)


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def main():
    path, limit, seeds = sys.argv[1], float(sys.argv[2]), int(sys.argv[3])
    scene = mi.load_file(path, optimize=False)
    integrator = scene.integrator()
    name = f"Mitsuba {mi.__version__}, {mi.variant()}"

    def read(spp, seed):
        before = cpu_seconds()
        images = [
            np.array(mi.render(scene, sensor=sensor, integrator=integrator, spp=spp, seed=seed)).astype(float)
            for sensor in scene.sensors()
        ]
        seconds = cpu_seconds() - before
        values = {sensor.id(): image.reshape(-1, image.shape[-1]).mean(axis=0).tolist()[:3]
                  for sensor, image in zip(scene.sensors(), images)}
        return {"peer": name, "points": spp, "seconds": seconds, "values": values}

    spp = 64
    while True:
        read(spp, 1000)
        runs = [read(spp, seed) for seed in range(seeds)]
        for run in runs:
            print(json.dumps(run), flush=True)
        if sum(run["seconds"] for run in runs) / seeds > limit or spp >= 1 << 24:
            return
        spp *= 4


main()
