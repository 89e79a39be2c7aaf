"""Materials and lamps that Mitsuba 3 has too, against Mitsuba 3 (pip install mitsuba numpy).

usage: python crosscheck.py PHOTONLAB [NAME...]

For each of them a scene is rendered by both programs at 24 x 24 pixels, media by every method of photonlab, and blocks of
4 x 4 pixels are compared: the difference over the joint uncertainty (standard errors of both, and photonlab's own bias bound). Nothing here is needed
to build, run or test the project.
"""
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import mitsuba as mi
import numpy as np

mi.set_variant("llvm_ad_rgb" if "llvm_ad_rgb" in mi.variants() and "--llvm" in sys.argv else "scalar_rgb")

SIZE, BLOCK, SPP, REPEATS = 24, 4, 256, 16

MATERIALS = {
    "diffuse": '<bsdf type="diffuse"><rgb name="reflectance" value="0.7 0.4 0.2"/></bsdf>',
    "mirror": '<bsdf type="conductor"><rgb name="specular_reflectance" value="0.9 0.8 0.7"/></bsdf>',
    "gold": '<bsdf type="conductor"><string name="material" value="Au"/></bsdf>',
    "glass": '<bsdf type="dielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf>',
    "thin-glass": '<bsdf type="thindielectric"/>',
    "rough-gold-ggx": '<bsdf type="roughconductor"><string name="material" value="Au"/><string name="distribution" value="ggx"/>'
    '<float name="alpha" value="0.3"/></bsdf>',
    "rough-copper-beckmann": '<bsdf type="roughconductor"><string name="material" value="Cu"/><float name="alpha" value="0.2"/></bsdf>',
    "rough-metal-grazing": '<bsdf type="roughconductor"><rgb name="eta" value="1.5 1.2 1"/><rgb name="k" value="5 4 3"/>'
    '<string name="distribution" value="ggx"/><float name="alpha" value="0.8"/></bsdf>',
    "rough-glass-ggx": '<bsdf type="roughdielectric"><string name="distribution" value="ggx"/><float name="alpha" value="0.3"/>'
    '<float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf>',
    "rough-glass-beckmann": '<bsdf type="roughdielectric"><float name="alpha" value="0.1"/></bsdf>',
    "plastic": '<bsdf type="plastic"><rgb name="diffuse_reflectance" value="0.6 0.3 0.1"/></bsdf>',
    "plastic-nonlinear": '<bsdf type="plastic"><rgb name="diffuse_reflectance" value="0.9 0.5 0.1"/><boolean name="nonlinear" value="true"/>'
    '<float name="int_ior" value="1.9"/></bsdf>',
    "mask": '<bsdf type="mask"><float name="opacity" value="0.4"/><bsdf type="twosided"><bsdf type="diffuse"/></bsdf></bsdf>',
    "two-sided": '<bsdf type="twosided"><bsdf type="plastic"/><bsdf type="roughconductor"/></bsdf>',
}


LAMPS = {
    "spot": '<emitter type="spot"><transform name="to_world"><lookat origin="0.5, 2, 2" target="0, -1, 0" up="0, 1, 0"/></transform>'
    '<rgb name="intensity" value="20 15 10"/><float name="cutoff_angle" value="35"/></emitter>',
    "narrow-spot": '<emitter type="spot"><transform name="to_world"><lookat origin="-1, 2, 1" target="0, -1, 0" up="0, 1, 0"/></transform>'
    '<rgb name="intensity" value="20"/><float name="cutoff_angle" value="40"/><float name="beam_width" value="5"/></emitter>',
    "constant": '<emitter type="constant"><rgb name="radiance" value="0.3 0.5 0.9"/></emitter>',
    "envmap": '<emitter type="envmap"><string name="filename" value="sky.exr"/><float name="scale" value="1.5"/></emitter>',
    "turned-envmap": '<emitter type="envmap"><string name="filename" value="sky.exr"/>'
    '<transform name="to_world"><rotate x="1" angle="60"/><rotate y="1" angle="100"/></transform></emitter>',
    "directional": '<emitter type="directional"><vector name="direction" x="-1" y="-2" z="-0.5"/><rgb name="irradiance" value="3 2 1"/></emitter>',
}


SENSORS = {
    "thin-lens": '<sensor type="thinlens"><float name="aperture_radius" value="0.25"/><float name="focus_distance" value="3"/>',
    "thin-lens-near-focus": '<sensor type="thinlens"><float name="aperture_radius" value="0.1"/><float name="focus_distance" value="1"/>',
}


# Things in the place of the room's ball and plate.
SHAPES = {
    "disk-lamp": '<shape type="disk"><transform name="to_world"><scale x="0.5" y="0.3"/><rotate x="1" angle="60"/><translate x="-0.3" y="0.2"/></transform>'
    '<emitter type="area"><rgb name="radiance" value="3 5 8"/></emitter></shape>'
    '<shape type="disk"><transform name="to_world"><scale value="0.5"/><rotate x="1" angle="-70"/><translate x="0.4" y="-0.6"/></transform></shape>',
    "cylinder-lamp": '<shape type="cylinder"><point name="p0" x="-0.6" y="-0.3" z="0"/><point name="p1" x="0.5" y="0.1" z="0.2"/><float name="radius" value="0.1"/>'
    '<emitter type="area"><rgb name="radiance" value="6 3 1"/></emitter></shape>',
    "cylinders": '<shape type="cylinder"><float name="radius" value="0.3"/><transform name="to_world"><rotate x="1" angle="-70"/><translate y="-0.6"/></transform>'
    '<bsdf type="twosided"><bsdf type="diffuse"><rgb name="reflectance" value="0.2 0.5 0.8"/></bsdf></bsdf></shape>'
    '<shape type="cylinder"><point name="p0" x="0.3" y="-0.9" z="0.3"/><point name="p1" x="0.7" y="-0.2" z="0.3"/><float name="radius" value="0.2"/>'
    '<boolean name="flip_normals" value="true"/><bsdf type="conductor"/></shape>',
    "obj": '<shape type="obj"><string name="filename" value="rock.obj"/><boolean name="face_normals" value="true"/>'
    '<transform name="to_world"><scale value="0.5"/><rotate x="0.6" y="0.8" angle="40"/><translate x="-0.4" y="-0.4"/></transform>'
    '<bsdf type="diffuse"><rgb name="reflectance" value="0.3 0.6 0.9"/></bsdf></shape>'
    '<shape type="ply"><string name="filename" value="rock.ply"/><boolean name="face_normals" value="true"/>'
    '<transform name="to_world"><scale value="0.3"/><translate x="0.5" y="-0.3"/></transform><bsdf type="dielectric"/></shape>',
    # Without face_normals both programs make smooth normals.
    "smooth-matte": '<shape type="obj"><string name="filename" value="rock.obj"/><bsdf type="diffuse"><rgb name="reflectance" value="0.8 0.5 0.3"/></bsdf></shape>',
    "smooth-plastic": '<shape type="obj"><string name="filename" value="rock.obj"/><transform name="to_world"><scale x="1" y="0.6" z="0.9"/><rotate z="1" angle="30"/></transform>'
    '<bsdf type="plastic"><rgb name="diffuse_reflectance" value="0.6 0.3 0.1"/></bsdf></shape>',
    "smooth-metal": '<shape type="ply"><string name="filename" value="rock.ply"/><bsdf type="roughconductor"><string name="material" value="Au"/>'
    '<string name="distribution" value="ggx"/><float name="alpha" value="0.3"/></bsdf></shape>',
    "smooth-mirror": '<shape type="ply"><string name="filename" value="rock.ply"/><bsdf type="conductor"><rgb name="specular_reflectance" value="0.9 0.8 0.7"/></bsdf></shape>',
    "obj-lamp": '<shape type="obj"><string name="filename" value="rock.obj"/><boolean name="face_normals" value="true"/>'
    '<transform name="to_world"><scale value="0.2"/></transform><emitter type="area"><rgb name="radiance" value="9 6 3"/></emitter></shape>',
}


# The room with a medium in it; Mitsuba follows light there by its integrator volpath.
MEDIA = {
    "fog-ball": '<shape type="sphere"><float name="radius" value="0.7"/><bsdf type="null"/>'
    '<medium type="homogeneous" name="interior"><rgb name="sigma_t" value="0.2 0.4 0.8"/><float name="scale" value="5"/><rgb name="albedo" value="0.9 0.8 0.5"/></medium></shape>',
    "fog-forward": '<shape type="cube"><transform name="to_world"><scale value="0.6"/></transform><bsdf type="null"/>'
    '<medium type="homogeneous" name="interior"><float name="sigma_t" value="3"/><rgb name="albedo" value="0.99 0.9 0.7"/>'
    '<phase type="hg"><float name="g" value="0.7"/></phase></medium></shape>'
    '<shape type="sphere"><float name="radius" value="0.3"/></shape>',
    "milk-glass": '<shape type="sphere"><float name="radius" value="0.6"/><bsdf type="dielectric"><float name="int_ior" value="1.3"/></bsdf>'
    '<medium type="homogeneous" name="interior"><rgb name="sigma_t" value="1 0.8 0.6"/><float name="scale" value="5"/><rgb name="albedo" value="0.95 0.9 0.99"/>'
    '<phase type="hg"><float name="g" value="-0.3"/></phase></medium></shape>',
    "smoked-glass": '<shape type="cube"><transform name="to_world"><scale value="0.4"/><rotate y="1" angle="30"/></transform><bsdf type="dielectric"/>'
    '<medium type="homogeneous" name="interior"><rgb name="sigma_t" value="0.05 0.25 0.75"/><float name="scale" value="4"/><float name="albedo" value="0"/></medium></shape>',
    # Where the fog reaches to within some 8 cm of the lamp, Mitsuba 3.9.1 loses up to half of what is scattered once below it: at y = 0.9
    # in a fog of half-width 0.96 it shows 0.724 where quadrature gives 1.1110 and photonlab 1.1148 +- 0.0027.
    "fog-room": '<shape type="cube"><transform name="to_world"><scale value="0.8"/></transform><bsdf type="null"/>'
    '<medium type="homogeneous" name="interior"><rgb name="sigma_t" value="0.3 0.6 1"/><float name="albedo" value="0.9"/></medium></shape>',
    "lamp-in-fog": '<medium type="homogeneous" id="fog"><rgb name="sigma_t" value="1 0.75 0.5"/><float name="scale" value="2"/><rgb name="albedo" value="0.9 0.8 0.7"/></medium>'
    '<shape type="cube"><transform name="to_world"><scale value="0.8"/></transform><bsdf type="null"/><ref name="interior" id="fog"/></shape>'
    '<shape type="sphere"><point name="center" x="0.2" y="-0.1" z="0.1"/><float name="radius" value="0.1"/><ref name="exterior" id="fog"/>'
    '<bsdf type="diffuse"><float name="reflectance" value="0"/></bsdf><emitter type="area"><rgb name="radiance" value="8 12 16"/></emitter></shape>',
    "amber-ball": '<shape type="sphere"><float name="radius" value="0.6"/><bsdf type="dielectric"><float name="int_ior" value="1.5"/><float name="ext_ior" value="1"/></bsdf>'
    '<medium type="homogeneous" name="interior"><rgb name="sigma_t" value="0.2 0.4 1"/><float name="scale" value="3"/><rgb name="albedo" value="0.8 0.5 0.1"/></medium></shape>',
    "frosted-fog": '<shape type="sphere"><float name="radius" value="0.6"/><bsdf type="roughdielectric"><string name="distribution" value="ggx"/>'
    '<float name="alpha" value="0.3"/><float name="int_ior" value="1.4"/><float name="ext_ior" value="1"/></bsdf>'
    '<medium type="homogeneous" name="interior"><float name="sigma_t" value="2"/><rgb name="albedo" value="0.9 0.7 0.5"/></medium></shape>',
    "forward-slab": '<shape type="cube"><transform name="to_world"><scale x="0.9" y="0.15" z="0.9"/><translate y="0.3"/></transform><bsdf type="null"/>'
    '<medium type="homogeneous" name="interior"><rgb name="sigma_t" value="0.3 0.7 1"/><float name="scale" value="12"/><rgb name="albedo" value="0.99 0.95 0.9"/>'
    '<phase type="hg"><float name="g" value="0.85"/></phase></medium></shape>',
    "fog-in-fog": '<medium type="homogeneous" id="outer"><float name="sigma_t" value="0.8"/><rgb name="albedo" value="0.9 0.6 0.3"/></medium>'
    '<shape type="sphere"><float name="radius" value="0.8"/><bsdf type="null"/><ref name="interior" id="outer"/></shape>'
    '<shape type="sphere"><float name="radius" value="0.4"/><bsdf type="null"/><ref name="exterior" id="outer"/>'
    '<medium type="homogeneous" name="interior"><float name="sigma_t" value="5"/><rgb name="albedo" value="0.3 0.6 0.9"/>'
    '<phase type="hg"><float name="g" value="-0.5"/></phase></medium></shape>',
    "thin-filter": '<shape type="cube"><transform name="to_world"><scale x="0.8" y="0.02" z="0.8"/><translate y="0.2"/></transform><bsdf type="null"/>'
    '<medium type="homogeneous" name="interior"><rgb name="sigma_t" value="0.05 0.25 1"/><float name="scale" value="40"/><float name="albedo" value="0"/></medium></shape>',
}

# How photonlab renders them; all else it renders by its default method.
MEDIA_METHODS = ["final-gather", "path", "radius", "nearest"]


def write_rock(folder):
    """An icosahedron with its corners pulled about, as OBJ and as binary PLY."""
    g = (1 + 5**0.5) / 2
    corners = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6), (7, 1, 8)]
    faces += [(3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    pull = [1 + 0.2 * np.sin(3 * i) for i in range(12)]
    corners = [tuple(0.55 * pull[i] * x for x in corner) for i, corner in enumerate(corners)]
    lines = ["v %.9g %.9g %.9g" % corner for corner in corners] + ["f %d %d %d" % tuple(i + 1 for i in face) for face in faces]
    (folder / "rock.obj").write_text("\n".join(lines) + "\n")
    header = "ply\nformat binary_little_endian 1.0\nelement vertex 12\nproperty float x\nproperty float y\nproperty float z\n"
    header += "element face 20\nproperty list uchar int vertex_indices\nend_header\n"
    body = np.array(corners, "<f4").tobytes() + b"".join(b"\x03" + np.array(face, "<i4").tobytes() for face in faces)
    (folder / "rock.ply").write_bytes(header.encode() + body)


def write_sky(path):
    """A picture without any symmetry: a bright spot, a gradient in both directions, steps."""
    rows, columns = 24, 48
    v, u = np.mgrid[0:rows, 0:columns]
    sky = np.stack([0.2 + 0.8 * v / rows, 0.3 + 0.5 * np.sin(u * 0.3) ** 2, 0.1 + (u > 30) * (v < 9) * 1.0], axis=2)
    sky[6:9, 10:14] += [20, 12, 8]
    mi.Bitmap(sky.astype(np.float32)).write(str(path))


def courtyard(lamp):
    """An open scene: a floor, a ball and a shiny ball under a lamp; the camera sees beyond them. Mitsuba's path tracer cannot
    see a lamp without extent by way of a mirror, so that ball is rough under such lamps, as a mirror would be under others."""
    extended = "constant" in lamp or "envmap" in lamp
    ball = MATERIALS["mirror"] if extended else MATERIALS["rough-metal-grazing"]
    return f"""<scene version="3.0.0">
    <integrator type="path"><integer name="max_depth" value="-1"/></integrator>
    <sensor type="perspective"><float name="fov" value="50"/>
        <transform name="to_world"><lookat origin="0.3, 1.2, 4" target="0, -0.3, 0" up="0, 1, 0"/></transform>
        <film type="hdrfilm"><integer name="width" value="{SIZE}"/><integer name="height" value="{SIZE}"/><rfilter type="box"/></film>
        <sampler type="independent"/></sensor>
    <shape type="rectangle"><transform name="to_world"><scale value="2"/><rotate x="1" angle="-90"/><translate y="-1"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0.6 0.5 0.4"/></bsdf></shape>
    <shape type="sphere"><point name="center" x="-0.6" y="-0.5" z="0"/><float name="radius" value="0.5"/>
        <bsdf type="diffuse"><rgb name="reflectance" value="0.8 0.8 0.8"/></bsdf></shape>
    <shape type="sphere"><point name="center" x="0.6" y="-0.6" z="0.2"/><float name="radius" value="0.4"/>
        {ball}</shape>
    {lamp}
</scene>"""


def room(material, things=None):
    def wall(transform, colour):
        return (
            f'<shape type="rectangle"><transform name="to_world">{transform}</transform>'
            f'<bsdf type="diffuse"><rgb name="reflectance" value="{colour}"/></bsdf></shape>'
        )

    walls = [
        wall('<rotate x="1" angle="-90"/><translate y="-1"/>', "0.7 0.7 0.7"),
        wall('<rotate x="1" angle="90"/><translate y="1"/>', "0.7 0.7 0.7"),
        wall('<translate z="-1"/>', "0.7 0.7 0.7"),
        wall('<rotate y="1" angle="90"/><translate x="-1"/>', "0.6 0.1 0.1"),
        wall('<rotate y="1" angle="-90"/><translate x="1"/>', "0.1 0.5 0.1"),
    ]
    things = things or f"""<shape type="sphere"><point name="center" x="-0.45" y="-0.5" z="-0.2"/><float name="radius" value="0.4"/>{material}</shape>
    <shape type="rectangle"><transform name="to_world"><scale value="0.35"/><rotate x="1" angle="-30"/><rotate y="1" angle="-30"/>
        <translate x="0.45" y="-0.2" z="0.1"/></transform>{material}</shape>"""
    return f"""<scene version="3.0.0">
    <integrator type="path"><integer name="max_depth" value="-1"/></integrator>
    <sensor type="perspective"><float name="fov" value="40"/>
        <transform name="to_world"><lookat origin="0, 0, 3.6" target="0, 0, 0" up="0, 1, 0"/></transform>
        <film type="hdrfilm"><integer name="width" value="{SIZE}"/><integer name="height" value="{SIZE}"/><rfilter type="box"/></film>
        <sampler type="independent"/></sensor>
    {"".join(walls)}
    <shape type="rectangle"><transform name="to_world"><rotate x="1" angle="90"/><scale value="0.5"/><translate y="0.98"/></transform>
        <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>
        <emitter type="area"><rgb name="radiance" value="8 7 5"/></emitter></shape>
    {things}
</scene>"""


def blocks(image):
    n = SIZE // BLOCK
    return image[:, :, :3].reshape(n, BLOCK, n, BLOCK, 3).mean(axis=(1, 3))


def compare(photonlab, name, folder, methods):
    path = folder / f"{name}.xml"
    if name in SENSORS:
        path.write_text(courtyard(LAMPS["spot"]).replace('<sensor type="perspective">', SENSORS[name]))
    elif name in MEDIA:
        path.write_text(room("", MEDIA[name]).replace('integrator type="path"', 'integrator type="volpath"'))
    elif name in SHAPES:
        path.write_text(room("", SHAPES[name]))
    else:
        path.write_text(courtyard(LAMPS[name]) if name in LAMPS else room(MATERIALS[name]))
    scene = mi.load_file(str(path))
    runs = np.array([blocks(np.array(mi.render(scene, spp=SPP, seed=i))) for i in range(REPEATS)])
    for method in methods:
        compare_method(photonlab, name, folder, method, runs)


def compare_method(photonlab, name, folder, method, runs):
    path = folder / f"{name}.xml"
    theirs, their_error = runs.mean(axis=0), runs.std(axis=0, ddof=1) / REPEATS**0.5
    ours, bound = [], []
    for seed in range(REPEATS):
        out = folder / f"{name}.exr"
        options = ["--spp", "256", "--passes", "4", "--seed", str(seed), "--method", method]
        options += [] if method == "path" else ["--photons", "1e6"]
        subprocess.run([photonlab, "render", path, "-o", out, *options], check=True, capture_output=True)
        bitmap = mi.Bitmap(str(out))
        layers = {channel.name: i for i, channel in enumerate(bitmap.struct_())}
        data = np.array(bitmap)
        pick = lambda prefix: np.stack([data[:, :, layers[prefix + c]] for c in "RGB"], axis=2)
        ours.append(blocks(pick("")))
        bound.append(blocks(pick("bias_bound.")))
    ours, bound = np.array(ours), np.array(bound).mean(axis=0)
    mean, error = ours.mean(axis=0), ours.std(axis=0, ddof=1) / REPEATS**0.5
    joint = np.hypot(error, their_error)
    joint = np.maximum(joint, 1e-5 * theirs.mean())
    z = (mean - theirs) / joint
    beyond = np.maximum(np.abs(mean - theirs) - bound, 0) / joint
    total = mean.mean() / theirs.mean() - 1
    total_error = np.hypot(ours.mean(axis=(1, 2, 3)).std(ddof=1), runs.mean(axis=(1, 2, 3)).std(ddof=1)) / REPEATS**0.5 / theirs.mean()
    print(
        f"{name + ' ' + method:36} mean {100 * total:+.2f} % +- {100 * total_error:.2f}  rms z {np.sqrt((z**2).mean()):.2f}  "
        f"worst z {np.abs(z).max():.1f}  beyond the bias bound {beyond.max():.1f}",
        flush=True,
    )


if __name__ == "__main__":
    arguments = [a for a in sys.argv[1:] if not a.startswith("--")]
    with tempfile.TemporaryDirectory() as folder:
        write_sky(Path(folder) / "sky.exr")
        write_rock(Path(folder))
        for name in arguments[1:] or [*MATERIALS, *SHAPES, *MEDIA, *LAMPS, *SENSORS]:
            compare(arguments[0], name, Path(folder), MEDIA_METHODS if name in MEDIA else ["final-gather"])
