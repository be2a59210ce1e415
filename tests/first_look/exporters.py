#!/usr/bin/env python3
"""tests/first_look/exporters.py FOLDER: what Debian's exporters write of the models of shapes.py, by each one that is installed.

Blender (blender), assimp (assimp-utils), MeshLab (meshlab), FreeCAD (freecad-python3) and pycollada (python3-collada). A program that is
missing or fails is named, and its part left out.
"""
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import corpus  # noqa: E402
import shapes  # noqa: E402
from dae import Document, Look  # noqa: E402

MODELS = (
    "chair",
    "table",
    "shelf",
    "house",
    "tower",
    "car",
    "truck",
    "plane",
    "person",
    "dog",
    "robot_arm",
    "rover",
    "gear",
    "bolt",
    "crate",
    "column_temple",
)
SYSTEM = {
    **os.environ,
    "PATH": "/usr/bin:/bin",
    "XDG_RUNTIME_DIR": "/tmp",
    "PYTHONDONTWRITEBYTECODE": "1",
}  # Debian's own python


def obj(folder, name, textured):
    """NAME.obj and NAME.mtl, its first material with a picture."""
    mesh = getattr(shapes, name)()
    materials = mesh.materials()
    lines = [f"mtllib {name}.mtl"] + ["v " + " ".join(f"{c:.6f}" for c in (p[0], p[2], -p[1])) for p in mesh.points]
    lines += [f"vt {u:.4f} {v:.4f}" for _, _, uv in mesh.faces for u, v in uv]
    texture = 1
    for material in materials:
        lines.append(f"usemtl {material}")
        at = texture
        for face, m, uv in mesh.faces:
            if m == material:
                lines.append("f " + " ".join(f"{k + 1}/{at + i}" for i, k in enumerate(face)))
            at += len(uv)
    mtl = []
    for material in materials:
        r, g, b = corpus.PAINT[material]
        mtl += [f"newmtl {material}", f"Kd {r} {g} {b}", "Ka 0 0 0", "Ks 0.2 0.2 0.2", "Ns 20", "d 1"]
        if textured and material == materials[0]:
            mtl.append(f"map_Kd textures/{name}.png")
            corpus.picture(folder, f"textures/{name}.png", "planks")
    (folder / f"{name}.obj").write_text("\n".join(lines) + "\n")
    (folder / f"{name}.mtl").write_text("\n".join(mtl) + "\n")
    return folder / f"{name}.obj"


def ply(folder, name):
    """NAME.ply with a colour a vertex."""
    mesh = getattr(shapes, name)()
    colour = {}
    for face, m, _ in mesh.faces:
        for k in face:
            colour[k] = corpus.PAINT[m]
    rows = [
        " ".join(f"{c:.6f}" for c in p) + " " + " ".join(str(int(255 * c)) for c in colour.get(k, (0.5, 0.5, 0.5)))
        for k, p in enumerate(mesh.points)
    ]
    head = [
        "ply",
        "format ascii 1.0",
        f"element vertex {len(rows)}",
        "property float x",
        "property float y",
        "property float z",
        "property uchar red",
        "property uchar green",
        "property uchar blue",
        f"element face {len(mesh.faces)}",
        "property list uchar int vertex_indices",
        "end_header",
    ]
    (folder / f"{name}.ply").write_text(
        "\n".join(head + rows + [f"{len(f)} " + " ".join(map(str, f)) for f, _, _ in mesh.faces]) + "\n"
    )
    return folder / f"{name}.ply"


def source_dae(folder, sources, name):
    """A document with a picture, for a program that reads COLLADA and writes it."""
    mesh = getattr(shapes, name)()
    document = Document("shapes", 1)
    for where in (folder, sources):
        corpus.picture(where, f"{name}.png", "planks")
    document.image("picture", f"{name}.png")
    for k, material in enumerate(mesh.materials()):
        document.look(material, Look(diffuse="picture" if k == 0 else corpus.PAINT[material]))
    document.show(name, mesh)
    document.write(sources / f"{name}.dae")
    return sources / f"{name}.dae"


def stl(folder, name):
    mesh = getattr(shapes, name)()
    lines = ["solid part"]
    for face, _, _ in mesh.faces:
        n = shapes.unit(mesh.face_normal(face))
        for k in range(1, len(face) - 1):
            corners = "".join(
                f" vertex {' '.join(f'{1000 * c:.4f}' for c in mesh.points[i])}\n"
                for i in (face[0], face[k], face[k + 1])
            )
            lines.append(f"facet normal {n[0]:.5f} {n[1]:.5f} {n[2]:.5f}\nouter loop\n{corners}endloop\nendfacet")
    (folder / f"{name}.stl").write_text("\n".join(lines) + "\nendsolid part\n")
    return folder / f"{name}.stl"


def call(name, *words, seconds=300):
    """Runs an exporter; what it said where it failed."""
    try:
        done = subprocess.run(
            [str(w) for w in words],
            capture_output=True,
            text=True,
            errors="replace",
            env=SYSTEM,
            timeout=seconds,
            stdin=subprocess.DEVNULL,
        )
    except subprocess.TimeoutExpired:
        print(f"{name}: over {seconds} s")
        return False
    if done.returncode:
        print(f"{name}: exit {done.returncode}: {(done.stderr or done.stdout).strip()[-200:]}")
    return done.returncode == 0


def assimp(folder):
    sources = folder.parent / "assimp_sources"
    sources.mkdir(parents=True, exist_ok=True)
    for k, name in enumerate(MODELS):
        source = (obj(sources, name, k % 2 == 0), ply(sources, name), stl(sources, name))[
            0 if k % 4 < 2 else k % 4 - 1
        ]
        call("assimp", "assimp", "export", source, folder / f"{name}.dae")
    if (sources / "textures").exists():
        shutil.copytree(sources / "textures", folder / "textures", dirs_exist_ok=True)
    again = folder.parent / "assimp_corpus"
    corpus.write(again)
    for path in (
        "max/rgb_zero_black.dae",
        "maya/hound.dae",
        "blender/character.dae",
        "blender/sun_watts.dae",
        "sketchup/tower.dae",
        "urdf/nested/arm.dae",
        "cad/bracket_mm.dae",
    ):
        call("assimp", "assimp", "export", again / path, folder / ("again_" + Path(path).name))
    shutil.rmtree(again)
    shutil.rmtree(sources)


def meshlab(folder):
    sources = folder.parent / "meshlab_sources"
    sources.mkdir(parents=True, exist_ok=True)
    server = (
        ("xvfb-run", "-a", "meshlabserver") if shutil.which("xvfb-run") else ("meshlabserver",)
    )  # it wants OpenGL
    for k, name in enumerate(MODELS):
        textured = k % 2 == 0
        source = (
            source_dae(folder, sources, name) if textured else ply(sources, name)
        )  # its reader of .obj aborts on ours
        call(
            "meshlabserver",
            *server,
            "-i",
            source,
            "-o",
            folder / f"{name}.dae",
            "-m",
            *(("wt", "vn") if textured else ("vc", "vn") if k % 4 == 1 else ("vc",)),
            seconds=60,
        )
    shutil.rmtree(sources)


def pycollada(folder):
    call("pycollada", "/usr/bin/python3", HERE / "pycollada_dae.py", folder, *MODELS)


def blender(folder):
    call("blender", "blender", "-b", "--factory-startup", "-P", HERE / "blender_dae.py", "--", folder, *MODELS)


def freecad(folder):
    sources = folder.parent / "freecad_sources"
    sources.mkdir(parents=True, exist_ok=True)
    for name in MODELS[::2]:
        stl(sources, name)
    script = sources / "export.py"
    script.write_text(
        "import sys\nsys.dont_write_bytecode = True\nimport FreeCAD, Mesh, importDAE\nfrom pathlib import Path\n"
        f"for part in sorted(Path({str(sources)!r}).glob('*.stl')):\n"
        "    document = FreeCAD.newDocument(part.stem)\n    Mesh.insert(str(part), part.stem)\n    document.recompute()\n"
        f"    importDAE.export(document.Objects, str(Path({str(folder)!r}) / (part.stem + '.dae')))\n"
        "import Part\ndocument = FreeCAD.newDocument('solids')\nbody = document.addObject('Part::Feature', 'Flange')\n"
        "body.Shape = Part.makeCylinder(40, 12).cut(Part.makeCylinder(15, 12)).fuse(Part.makeBox(120, 30, 8))\ndocument.recompute()\n"
        f"importDAE.export([body], str(Path({str(folder)!r}) / 'flange.dae'))\n"
    )
    program = shutil.which("freecadcmd-python3") or shutil.which("freecadcmd") or shutil.which("FreeCADCmd")
    call("freecad", program, script)
    shutil.rmtree(sources)


PROGRAMS = (
    (
        "pycollada",
        pycollada,
        lambda: subprocess.run(["/usr/bin/python3", "-c", "import collada"], capture_output=True).returncode == 0,
    ),
    ("assimp", assimp, lambda: shutil.which("assimp")),
    ("meshlab", meshlab, lambda: shutil.which("meshlabserver")),
    ("blender", blender, lambda: shutil.which("blender")),
    ("freecad", freecad, lambda: any(map(shutil.which, ("freecadcmd-python3", "freecadcmd", "FreeCADCmd")))),
)


def write(root):
    """All documents, in a folder a program; path -> expectations."""
    root = Path(root)
    for name, function, there in PROGRAMS:
        if not there():
            print(f"{name}: not installed, left out")
            continue
        folder = root / name
        folder.mkdir(parents=True, exist_ok=True)
        function(folder)
        print(f"{name}: {len(list(folder.rglob('*.dae')))} documents")
    expected = {"blender/empty.dae": {"nothing": True}}
    (root / "corpus.json").write_text(json.dumps(expected) + "\n")
    return expected


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n")[0])
    write(sys.argv[1])
