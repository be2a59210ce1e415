"""tests/first_look/pycollada_dae.py FOLDER MODEL...: writes models by pycollada; run by exporters.py with Debian's python."""
import sys
from pathlib import Path

import collada
import numpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
import corpus  # noqa: E402
import shapes  # noqa: E402


def write(folder, name, way):
    mesh = getattr(shapes, name)()
    scale = (1, 1000, 1 / 0.0254)[way % 3]
    document = collada.Collada()
    document.assetInfo.upaxis = collada.asset.UP_AXIS.Z_UP if way % 2 else collada.asset.UP_AXIS.Y_UP
    document.assetInfo.unitname, document.assetInfo.unitmeter = (
        ("meter", 1),
        ("millimeter", 0.001),
        ("inch", 0.0254),
    )[way % 3]
    points = numpy.array([p if way % 2 else (p[0], p[2], -p[1]) for p in mesh.points]) * scale
    arrays = [collada.source.FloatSource("points", points.flatten(), ("X", "Y", "Z"))]
    smooth = way % 4 != 3  # one in four without normals
    if smooth:
        normals = numpy.array([n if way % 2 else (n[0], n[2], -n[1]) for n in mesh.smooth_normals()])
        arrays.append(collada.source.FloatSource("normals", normals.flatten(), ("X", "Y", "Z")))
    uvs = numpy.array([c for _, _, uv in mesh.faces for c in uv])
    arrays.append(collada.source.FloatSource("uvs", uvs.flatten(), ("S", "T")))
    geometry = collada.geometry.Geometry(document, "geometry0", name, arrays)
    bound = []
    for number, material in enumerate(mesh.materials()):
        colour = corpus.PAINT[material]
        params = []
        if number == 0 and way % 2 == 0:
            corpus.picture(folder, f"textures/{name}.png", "livery")
            image = collada.material.CImage(f"{name}-image", f"textures/{name}.png", document)
            surface = collada.material.Surface(f"{name}-surface", image)
            sampler = collada.material.Sampler2D(f"{name}-sampler", surface)
            params = [surface, sampler]
            colour = collada.material.Map(sampler, "UVSET0")
            document.images.append(image)
        effect = collada.material.Effect(
            f"effect{number}",
            params,
            ("lambert", "phong", "blinn")[way % 3],
            diffuse=colour,
            specular=(0.1, 0.1, 0.1),
            double_sided=way % 5 == 0,
        )
        entry = collada.material.Material(f"material{number}", material, effect)
        document.effects.append(effect)
        document.materials.append(entry)
        bound.append(collada.scene.MaterialNode(f"symbol{number}", entry, inputs=[("UVSET0", "TEXCOORD", "0")]))
        inputs = collada.source.InputList()
        inputs.addInput(0, "VERTEX", "#points")
        if smooth:
            inputs.addInput(1, "NORMAL", "#normals")
        inputs.addInput(2 if smooth else 1, "TEXCOORD", "#uvs", set="0")
        index, counts, at = [], [], 0
        for face, m, uv in mesh.faces:
            if m == material:
                counts.append(len(face))
                for i, k in enumerate(face):
                    index += [k, k, at + i] if smooth else [k, at + i]
            at += len(uv)
        geometry.primitives.append(
            geometry.createPolylist(numpy.array(index), numpy.array(counts), inputs, f"symbol{number}")
        )
    document.geometries.append(geometry)
    node = collada.scene.Node(
        "node0",
        children=[collada.scene.GeometryNode(geometry, bound)],
        transforms=[collada.scene.TranslateTransform(3 * scale, 0, 0)] if way % 3 == 1 else [],
    )
    scene = collada.scene.Scene("scene0", [node])
    document.scenes.append(scene)
    document.scene = scene
    document.write(str(folder / f"{name}.dae"))


target = Path(sys.argv[1])
for position, model in enumerate(sys.argv[2:]):
    write(target, model, position)
