"""tests/programs/convert/convert_test.py: kinora-convert as its users run it: pictures before and after,
and the judgement of Khronos' glTF-Validator (scripts/npm_packages; skipped without)."""
import base64
import json
import math
import os
import re
import shutil
import struct
import subprocess
import sys
import unittest
import zipfile
import zlib
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import programs
from programs import (MATTE, SCENES, SHADERS, SHARED, SOURCE, TEST_DATA, ProgramTest, blender_writes_gltf, render,
                      run)

sys.path.insert(0, str(SOURCE / "scripts/sheet"))
import png  # noqa: E402

NPM = SOURCE / "build/npm"
SHARED_SCENES = SHARED / "scenes" if (SHARED / "scenes").is_dir() else None
# Of a picture: the mean difference of its bytes (0..255).
SAME = 0.02     # the same scene by other numbers: last bits of positions
LIKE = 1.0      # other arithmetic: floats for doubles, keys for curves
PICTURE = ("--size", "128x96", "--quality", "preview", "--threads", "2", "--progress", "none")


def convert(*words, **options):
    return run("kinora-convert", *words, **options)


def mesh_scene(body="", effects="", asset="<asset><created>2026-01-01T00:00:00Z</created>"
               "<modified>2026-01-01T00:00:00Z</modified><unit meter=\"1\"/></asset>"):
    """A triangle, wearing `red`; `body` stands before the libraries' end."""
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">{asset}
<library_effects><effect id="red-fx"><profile_COMMON><technique sid="c"><lambert>
<diffuse><color>0.8 0.1 0.1 1</color></diffuse></lambert></technique></profile_COMMON></effect>{effects}</library_effects>
<library_materials><material id="red" name="Red"><instance_effect url="#red-fx"/></material></library_materials>
<library_geometries><geometry id="tri"><mesh><source id="p"><float_array id="pa" count="9">-1 0 0 1 0 0 0 1.5 0</float_array>
<technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>
{body}
<library_visual_scenes><visual_scene id="vs"><node id="n"><translate sid="t">0 0 0</translate><rotate sid="r">0 1 0 20</rotate>
<instance_geometry url="#tri"><bind_material><technique_common><instance_material symbol="m" target="#red"/></technique_common>
</bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#vs"/></scene></COLLADA>
"""


def skin_scene(inverse_bind, bind_shape="", influences="0 0 0 0 0 0", up="Y_UP", meter="1"):
    """A triangle on a joint that turns and wanders, instanced below another node; seen from the front."""
    identity = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"

    def source(name, kind, values, param, stride=1):
        count = len(values.split())
        return (f'<source id="{name}"><{kind} id="{name}a" count="{count}">{values}</{kind}><technique_common>'
                f'<accessor source="#{name}a" count="{count // stride}" stride="{stride}">{param}</accessor>'
                "</technique_common></source>")

    def channel(name, target, values):
        return (f'<animation id="{name}">' + source(name + "i", "float_array", "0 1", '<param name="TIME" type="float"/>') +
                source(name + "o", "float_array", values, '<param name="X" type="float"/>') +
                f'<sampler id="{name}s"><input semantic="INPUT" source="#{name}i"/><input semantic="OUTPUT" '
                f'source="#{name}o"/></sampler><channel source="#{name}s" target="{target}"/></animation>')
    xyz = "".join(f'<param name="{c}" type="float"/>' for c in "XYZ")
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><created>2026-01-01T00:00:00Z</created>
<modified>2026-01-01T00:00:00Z</modified><unit meter="{meter}"/><up_axis>{up}</up_axis></asset>
<library_animations>{channel("a", "j/t.X", "1 1.5")}{channel("b", "j/r.ANGLE", "0 50")}</library_animations>
<library_cameras><camera id="c"><optics><technique_common><orthographic><xmag>3</xmag><ymag>3</ymag><znear>.1</znear>
<zfar>100</zfar></orthographic></technique_common></optics></camera></library_cameras>
<library_geometries><geometry id="g"><mesh>{source("p", "float_array", "0 0 0 1 0 0 0 1 0", xyz, 3)}
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>
<library_controllers><controller id="k"><skin source="#g">{bind_shape and f"<bind_shape_matrix>{bind_shape}</bind_shape_matrix>"}
{source("kj", "Name_array", "j", '<param name="JOINT" type="name"/>')}
{source("kb", "float_array", inverse_bind or identity, '<param name="TRANSFORM" type="float4x4"/>', 16)}
{source("kw", "float_array", "1", '<param name="WEIGHT" type="float"/>')}
<joints><input semantic="JOINT" source="#kj"/><input semantic="INV_BIND_MATRIX" source="#kb"/></joints>
<vertex_weights count="3"><input semantic="JOINT" source="#kj" offset="0"/><input semantic="WEIGHT" source="#kw" offset="1"/>
<vcount>1 1 1</vcount><v>{influences}</v></vertex_weights></skin></controller></library_controllers>
<library_visual_scenes><visual_scene id="s"><node id="j" sid="j" type="JOINT"><translate sid="t">1 0 0</translate>
<rotate sid="r">0 0 1 0</rotate></node><node id="sk"><translate>0.5 1 0.2</translate><instance_controller url="#k">
<skeleton>#j</skeleton></instance_controller></node><node id="cam"><translate>0 0 10</translate><instance_camera url="#c"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
"""


def glb_json(path):
    data = Path(path).read_bytes()
    magic, version, size, length, kind = struct.unpack("<IIIII", data[:20])
    assert magic == 0x46546C67 and version == 2 and size == len(data) and kind == 0x4E4F534A
    return json.loads(data[20:20 + length])


def outline(path):
    """Whether each pixel is covered."""
    parts = list(png.chunks(Path(path).read_bytes()))
    width, height, depth, color = struct.unpack(">IIBB", parts[0][1][:10])
    assert depth == 8 and color == 6
    data = zlib.decompress(b"".join(body for kind, body in parts if kind == b"IDAT"))
    covered, above = [], bytes(width * 4)
    for y in range(height):
        at = y * (width * 4 + 1)
        above = png.unfilter(data[at], bytearray(data[at + 1:at + 1 + width * 4]), above, 4)
        covered += [alpha > 127 for alpha in above[3::4]]
    return covered


def validated(files):
    """glTF-Validator's reports, by file; None where it is not installed."""
    if not (NPM / "node_modules/gltf-validator").is_dir():
        return None
    done = subprocess.run(["node", str(SOURCE / "tests/npm/validate_gltf.js"), *map(str, files)],
                          capture_output=True, text=True, timeout=300,
                          env={**os.environ, "NODE_PATH": str(NPM / "node_modules")})
    assert done.returncode == 0, done.stderr
    return {Path(r["file"]).name: r for r in map(json.loads, done.stdout.splitlines())}


class Convert(ProgramTest):
    def picture(self, scene, *words, spp=4):
        out = self.folder / f"{Path(scene).stem}-{len(list(self.folder.iterdir()))}.png"
        self.expect(render(scene, "-o", out, *PICTURE, "--spp", spp, *words), 0)
        return png.read(out)

    def difference(self, a, b):
        self.assertEqual(a[:2], b[:2])
        total = sum(abs(x - y) for p, q in zip(a[2], b[2]) for x, y in zip(p, q))
        return total / (3 * a[0] * a[1])

    def converted(self, scene, name, *words, code=0):
        out = self.folder / name
        self.expect(convert(scene, out, *words), code)
        return out


class ToDae(Convert):
    def test_canonical_text_is_a_fixed_point_and_shows_the_same(self):
        for scene in ("matte", "rays"):
            with self.subTest(scene):
                once = self.converted(SCENES / f"{scene}.dae", f"{scene}.dae")
                again = self.converted(once, f"{scene}2.dae")
                self.assertEqual(once.read_bytes(), again.read_bytes())
                self.assertEqual(self.picture(SCENES / f"{scene}.dae"), self.picture(once))

    def test_a_document_never_grows(self):
        scenes = list(SCENES.glob("*.dae"))
        if SHARED_SCENES:
            scenes += [SHARED_SCENES / name for name in ("thinmatrix_cowboy/model.dae", "cts_x_up/x_up.dae",
                                                         "gltf_box_animated/BoxAnimated.dae")]
        texts = {scene.stem: scene.read_bytes() for scene in scenes if scene.exists()}
        texts["indented"] = mesh_scene().encode()
        texts["flat"] = re.sub(r">\s+<", "><", mesh_scene()).encode()
        texts["bare"] = texts["flat"].split(b"?>", 1)[1].strip()
        for name, text in texts.items():
            with self.subTest(name):
                (self.folder / f"{name}.dae").write_bytes(text)
                out = self.converted(self.folder / f"{name}.dae", f"{name}_out.dae")
                self.assertLessEqual(out.stat().st_size, len(text))
                again = self.converted(out, f"{name}_again.dae")
                self.assertEqual(again.read_bytes(), out.read_bytes())
        self.whole_if(SHARED_SCENES)

    def test_each_input_has_its_own_index_after_gltf(self):
        """A cube of 8 places, 6 normals and 4 texture coordinates has 24 vertices in glTF."""
        places = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
        normals = [tuple(side if a == axis else 0 for a in range(3)) for axis in range(3) for side in (-1, 1)]
        corners = []
        for n, normal in enumerate(normals):
            face = [p for p, place in enumerate(places) if sum(map(lambda a, b: a * b, place, normal)) > 0]
            for k in (0, 1, 3, 0, 3, 2):
                corners += [face[k], n, k, k]

        def source(name, rows, params):
            return (f'<source id="{name}"><float_array id="{name}a" count="{len(rows) * len(params)}">'
                    + " ".join(str(x) for row in rows for x in row) + f'</float_array><technique_common><accessor source="#{name}a" '
                    f'count="{len(rows)}" stride="{len(params)}">' + "".join(f'<param name="{c}" type="float"/>' for c in params)
                    + "</accessor></technique_common></source>")
        uv = source("u", [(0.1, 0.1), (0.9, 0.1), (0.1, 0.9), (0.9, 0.9)], "ST")
        mesh = (source("p", [[0.1 * x for x in place] for place in places], "XYZ") + source("n", normals, "XYZ") + uv +
                uv.replace('"u', '"w').replace('"#u', '"#w') + '<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>'
                '<triangles count="12" material="m"><input semantic="VERTEX" source="#v" offset="0"/><input semantic="NORMAL" '
                'source="#n" offset="1"/><input semantic="TEXCOORD" source="#u" offset="2" set="0"/><input semantic="TEXCOORD" '
                f'source="#w" offset="3" set="1"/><p>{" ".join(map(str, corners))}</p></triangles>')
        scene = self.write("cube.dae", re.sub("(?s)<mesh>.*</mesh>", f"<mesh>{mesh}</mesh>", mesh_scene()))
        out = self.converted(self.converted(scene, "cube.glb"), "back.dae")
        text = out.read_text()
        arrays = re.findall('<float_array [^>]*count="([0-9]+)">([^<]*)<', text)
        self.assertEqual([int(count) for count, _ in arrays], [8 * 3, 6 * 3, 4 * 2])  # the second set shares the array
        self.assertEqual(set(arrays[0][1].split()), {"-0.1", "0.1"})
        self.assertEqual(len(re.findall('<input semantic="TEXCOORD"', text)), 2)
        self.assertEqual(len(re.search("<p>(.*?)</p>", text).group(1).split()), 36 * 3)
        self.assertLess(self.difference(self.picture(out), self.picture(scene)), SAME)

    def test_skins_and_morphs_keep_their_shape_with_fewer_vertices(self):
        if not SHARED_SCENES:
            self.skipTest("no shared scenes")
        for name, time in (("thinmatrix_cowboy/model.dae", "0.4"), ("gltf_box_animated/BoxAnimated.dae", "1")):
            scene = SHARED_SCENES / name
            with self.subTest(name):
                binary = self.converted(scene, "a.glb")
                out = self.converted(binary, "a.dae")
                self.assertLess(self.difference(self.picture(out, "--time", time), self.picture(binary, "--time", time)), SAME)
                part = lambda path: len(re.search("(?s)<library_geometries.*</library_geometries>", path.read_text()).group())
                self.assertLessEqual(part(out), 1.5 * part(scene))

    def test_axes_and_unit_change_and_the_picture_stays(self):
        scenes = [(SCENES / "matte.dae", "Z", "0.01", "0")]
        if SHARED_SCENES:
            scenes += [(SHARED_SCENES / name, up, unit, time) for name, up, unit, time in (
                ("thinmatrix_cowboy/model.dae", "Y", "0.01", "0.4"),
                ("gltf_rigged_figure/RiggedFigure.dae", "X", "2", "0.6"),
                ("cts_skin_2_influence/skin_2_influence.dae", "Z", "5", "0.5"))]
        for scene, up, unit, time in scenes:
            with self.subTest(scene.name):
                if not scene.exists():
                    continue
                out = self.converted(scene, f"{scene.stem}.dae", "--up", up, "--unit", unit)
                text = out.read_text()
                self.assertIn(f"<up_axis>{up}_UP</up_axis>", text)
                self.assertIn(f'meter="{unit}"', text)
                before = self.picture(scene, "--time", time)
                after = self.picture(out, "--time", time)
                self.assertLess(self.difference(before, after), LIKE)
        self.whole_if(SHARED_SCENES)

    def same_picture_with_other_axes(self, scene):
        for words in (("--up", "Z"), ("--up", "X"), ("--unit", "0.01")):
            out = self.converted(scene, f"{scene.stem}{words[1]}.dae", *words)
            for time in ("0", "1"):
                with self.subTest(f"{scene.name} {words} {time}"):
                    before = self.picture(scene, "--time", time)
                    self.assertGreater(sum(map(sum, before[2])), 10000)
                    self.assertLess(self.difference(before, self.picture(out, "--time", time)), SAME)

    def test_a_skin_without_a_bind_shape_stands_where_it_stood(self):
        for name, inverse_bind in (("binds_node", "1 0 0 -1 0 1 0 0 0 0 1 0 0 0 0 1"),
                                   ("at_node", "1 0 0 -2 0 1 0 0 0 0 1 0 0 0 0 1"),
                                   ("world", "1 0 0 -0.5 0 1 0 1 0 0 1 0.2 0 0 0 1")):
            self.same_picture_with_other_axes(self.write(f"{name}.dae", skin_scene(inverse_bind)))

    def test_vertices_of_no_joint_come_along(self):
        shape = "0 -1 0 .3 1 0 0 .1 0 0 1 0 0 0 0 1"
        self.same_picture_with_other_axes(self.write("some.dae", skin_scene("", shape, "0 0 -1 0 0 0")))
        self.same_picture_with_other_axes(self.write("all.dae", skin_scene("", shape, "-1 0 -1 0 -1 0")))
        lost = self.write("lost.dae", skin_scene("", "", "0 0 -1 0 0 0"))
        self.expect(convert(lost, self.folder / "o.dae", "--up", "Z", "--strict"), 1, "CONVERT_LOST", "no joint")

    def test_other_encodings_are_read_once(self):
        text = mesh_scene().replace('"1.0"?>', '"1.0" encoding="ISO-8859-1"?>').replace('"Red"', '"Kopf\u00e9"')
        scene = self.folder / "a.dae"
        scene.write_bytes(text.encode("latin-1"))
        for words in ((), ("--up", "Z"), ("--shader", f"red={SHADERS / 'matte.sl'}")):
            for name in ("b.dae", "deep/b.dae"):
                self.assertIn('name="Kopf\u00e9"', self.converted(scene, name, *words).read_text())

    def test_the_asset_of_1_5_keeps_its_order(self):
        scene = self.write("a.dae", mesh_scene().replace("2005/11", "2008/03").replace('"1.4.1"', '"1.5.0"').replace(
            "<asset>", '<asset><coverage><geographic_location><longitude>1</longitude><latitude>2</latitude>'
            '<altitude mode="absolute">0</altitude></geographic_location></coverage>').replace('<unit meter="1"/>', ""))
        for words in (("--up", "Z"), ("--unit", "0.1")):
            out = self.converted(scene, "b.dae", *words)
            self.expect(run("kinora-validate", "--profile", "strict", "--only", "SCHEMA_", out), 0)

    def test_a_prefix_is_kept_by_what_is_added(self):
        text = re.sub(r"<(/?)(?=\w)", r"<\1c:", mesh_scene()).replace("xmlns=", "xmlns:c=")
        self.assertIn("<c:COLLADA xmlns:c=", text)
        scene = self.write("a.dae", text)
        for words in (("--up", "Z"), ("--unit", "0.1"), ("--shader", f"red={SHADERS / 'matte.sl'}")):
            out = self.converted(scene, "b.dae", *words)
            markup = re.sub(r"(?s)<!\[CDATA\[.*?\]\]>", "", out.read_text())
            self.assertEqual(re.findall(r"</?(?!c:)\w+", markup), [], words)
            self.expect(run("kinora-validate", "--profile", "strict", "--only", "SCHEMA_,XML_,DOC_", out), 0)
            self.assertLess(self.difference(self.picture(scene, *(words if "--shader" in words else ())),
                                            self.picture(out)), LIKE)

    def test_shader_code_that_measures_in_world_space_is_named_as_lost(self):
        self.expect(convert(SCENES / "walker.dae", self.folder / "a.dae", "--up", "Y", "--strict"), 1,
                    "CONVERT_LOST", "world")
        self.expect(convert(SCENES / "court.dae", self.folder / "b.dae", "--unit", "1", "--strict"), 1,
                    "CONVERT_LOST", "world units")
        self.expect(convert(SCENES / "court.dae", self.folder / "c.dae", "--unit", "0.1", "--strict"), 0)

    def test_lengths_of_cameras_and_lights_follow_the_unit(self):
        body = """<library_cameras><camera id="c"><optics><technique_common><perspective><yfov>40</yfov>
<znear sid="zn">0.5</znear><zfar>100</zfar></perspective></technique_common></optics></camera></library_cameras>
<library_lights><light id="l"><technique_common><point><color>1 1 1</color><linear_attenuation>2</linear_attenuation>
<quadratic_attenuation>4</quadratic_attenuation></point></technique_common></light></library_lights>"""
        out = self.converted(self.write("a.dae", mesh_scene(body)), "b.dae", "--unit", "0.5")
        text = out.read_text()
        # A camera clips in units of its node, which the wrapping matrix scales.
        for part in ('<znear sid="zn">0.5</znear>', "<zfar>100</zfar>", "<linear_attenuation>1<",
                     "<quadratic_attenuation>1<"):
            self.assertIn(part, text)

    def test_a_shader_is_embedded_and_shows_what_it_shows_as_an_option(self):
        scene, shader = SCENES / "matte.dae", SHADERS / "plastic.sl"
        out = self.converted(scene, "shaded.dae", "--shader", f"bright={shader}")
        self.assertEqual(out.read_text().count("<profile_RSL>"), 2)  # `dim` shared the effect
        self.assertLess(self.difference(self.picture(out),
                                        self.picture(scene, "--shader", f"bright={shader}")), SAME)

    def test_shaders_of_one_material_add_stages(self):
        surface = self.write("a.sl", "#define TINT color(0, 0.8, 0.1)\nsurface red_rock() { Ci = TINT; Oi = 1; }\n")
        bumps = self.write("b.sl", "#define TINT 0.3\ndisplacement bulge(float depth = TINT;) "
                                   "{ P += depth * normalize(N); N = calculatenormal(P); }\n")
        scene = SCENES / "matte.dae"
        both = ("--shader", f"bright={surface}", "--shader", f"bright={bumps}")
        shown = self.picture(scene, *both)
        self.assertGreater(self.difference(shown, self.picture(scene, *both[:2])), 1)
        for words in (both, both[2:] + both[:2]):
            out = self.converted(scene, "both.dae", *words)
            text = out.read_text()
            for stage in ("SURFACE", "DISPLACEMENT"):
                self.assertEqual(len(re.findall(f'stage="{stage}"', re.search(
                    r"(?s)<effect[^>]*-rsl\".*?</effect>", text).group())), 1)
            self.assertEqual(self.picture(out), shown)
        self.assertLess(self.difference(self.picture(self.converted(scene, "both.glb", *both)), shown), LIKE)
        # One at a time: what a document has stays as well.
        one = self.converted(scene, "one.dae", *both[:2])
        self.assertEqual(self.picture(self.converted(one, "two.dae", *both[2:])), shown)

    def test_a_stage_given_twice_is_replaced_with_a_finding(self):
        first = self.write("a.sl", "surface rock() { Ci = color(1, 0, 0); Oi = 1; }")
        bumps = self.write("d.sl", "displacement bulge() { P += 0.3 * normalize(N); N = calculatenormal(P); }")
        second = self.write("b.sl", "surface rock() { Ci = color(0, 1, 0); Oi = 1; }")  # of the same name
        scene = self.write("scene.dae", mesh_scene())
        words = [word for name in (first, bumps, second) for word in ("--shader", f"red={name}")]
        shown = self.picture(scene, *words[2:])
        for name in ("out.dae", "out.glb"):
            result = convert(scene, self.folder / name, *words)
            self.expect(result, 0, "CONVERT_STAGE_TWICE", "'red'", "surface", "a.sl", "b.sl")
            self.assertEqual(result.err.count("CONVERT_STAGE_TWICE"), 1)
            self.assertLess(self.difference(self.picture(self.folder / name), shown), SAME)
        self.assertNotIn("color(1, 0, 0)", (self.folder / "out.dae").read_text())
        self.assertNotIn("CONVERT_STAGE_TWICE", str(convert(scene, self.folder / "c.dae", *words[2:])))

    def test_codes_that_contradict_each_other_are_told(self):
        first = self.write("a.sl", "float f() { return 1; }\nsurface s() { Ci = f(); Oi = 1; }")
        second = self.write("b.sl", "float f() { return 2; }\ndisplacement d() { P += f() * N; }")
        scene = self.write("scene.dae", mesh_scene())
        self.expect(convert(scene, self.folder / "o.dae", "--shader", f"red={first}", "--shader", f"red={second}"),
                    4, "CONVERT_SHADER", "b.sl", "different names")
        self.write("b.sl", "float f() { return\n1; }\ndisplacement d() { P += f() * N; }")  # the same function
        self.converted(scene, "o.dae", "--shader", f"red={first}", "--shader", f"red={second}")

    def test_a_light_gets_its_shader(self):
        body = """<library_lights><light id="lamp"><technique_common><point><color>0.2 0.9 0.3</color></point>
</technique_common></light><light id="sun"><technique_common><directional><color>0.1 0.1 0.1</color></directional>
</technique_common></light></library_lights>"""
        text = mesh_scene(body).replace("</visual_scene>", '<node><translate>0 1 3</translate><instance_light '
                                        'url="#lamp"/><instance_light url="#sun"/></node></visual_scene>')
        scene = self.write("scene.dae", text)
        self.expect(render("--list", "lights", scene), 0, "lamp", "sun")
        glow = self.write("glow.sl", "light glow(float intensity = 3; color lightcolor = 1;) {\n"
                          '    illuminate(point "shader" (0, 0, 0)) Cl = intensity * lightcolor / (L . L);\n}')
        words = ("--shader", f"lamp={glow}")
        shown = self.picture(scene, *words)
        self.assertGreater(self.difference(shown, self.picture(scene)), 1)
        out = self.converted(scene, "out.dae", *words)
        self.assertEqual(self.picture(out), shown)
        self.assertEqual(out.read_text().count('<technique profile="RSL">'), 1)
        self.expect(run("kinora-validate", "--only", "SCHEMA_,LINK_,RSL_", out), 0)
        self.assertLess(self.difference(self.picture(self.converted(scene, "out.glb", *words)), shown), LIKE)
        # Again: the light's effect gets the other shader, and keeps what it gave.
        dim = self.write("dim.sl", glow.read_text().replace("intensity = 3", "intensity = 1").replace("glow", "dim"))
        again = self.converted(out, "again.dae", "--shader", f"lamp={dim}")
        self.assertEqual(self.picture(again), self.picture(scene, "--shader", f"lamp={dim}"))
        self.assertEqual(again.read_text().count("<effect "), 2)
        # On a material it shines from the geometry, beside the surface.
        on_mesh = self.converted(scene, "mesh.dae", "--shader", f"Red={glow}", "--shader", "Red=plastic")
        self.assertIn('<shader stage="LIGHT">', on_mesh.read_text())

    def test_our_shaders_go_by_name(self):
        scene = SCENES / "matte.dae"
        for name in ("out.dae", "out.glb"):
            out = self.converted(scene, name, "--shader", "bright=plastic")
            self.assertLess(self.difference(self.picture(out), self.picture(scene, "--shader", "bright=plastic")), LIKE)
            self.expect(convert(scene, self.folder / name, "--shader", "bright=plastik"), 2, "SHADER_UNKNOWN", "plastic")
            self.expect(convert(scene, self.folder / name, "--shader", "bright=tonemap"), 2, "SHADER_OF_OTHER_KIND")

    def test_a_shader_with_the_end_of_cdata_in_it_survives(self):
        code = 'surface odd(float a[2] = {0, 1};) {\n    float b[2] = {0, 0};\n    if (a[b[0]]>0 && 1 < 2)\n' \
               '        Ci = 1;\n    Ci = color(0, 1, 0);\n    Oi = 1;\n}\n'
        self.assertIn("]]>", code)
        shader = self.write("odd.sl", code)
        out = self.converted(self.write("a.dae", mesh_scene()), "b.dae", "--shader", f"Red={shader}")
        self.assertIn("<code><![CDATA[surface odd", out.read_text())
        self.expect(render("--list", "materials", out), 0)
        again = self.converted(out, "c.dae")
        self.assertEqual(out.read_bytes(), again.read_bytes())

    def test_relative_links_are_moved_with_the_file(self):
        body = '<library_images><image id="i"><init_from>pictures/a%20b.png</init_from></image></library_images>'
        self.write("pictures/a b.png", "x")
        scene = self.write("a.dae", mesh_scene(body))
        out = self.converted(scene, "deep/er/b.dae")
        self.assertIn("<init_from>../../pictures/a%20b.png</init_from>", out.read_text())
        self.assertNotIn("CONVERT_OUTSIDE", str(convert(scene, out)))  # a picture may lie anywhere
        self.assertNotIn("CONVERT_OUTSIDE", str(convert(scene, self.folder / "c.dae")))

    def textured(self, link):
        return mesh_scene(f'<library_images><image id="wood"><init_from>{link}</init_from></image></library_images>').replace(
            '<technique sid="c"><lambert>\n<diffuse><color>0.8 0.1 0.1 1</color></diffuse>',
            '<newparam sid="f"><surface type="2D"><init_from>wood</init_from></surface></newparam><newparam sid="s">'
            '<sampler2D><source>f</source></sampler2D></newparam><technique sid="c"><lambert>'
            '<diffuse><texture texture="s" texcoord="UV"/></diffuse>')

    def test_a_picture_is_linked_where_it_was_found(self):
        """Exporters' absolute paths and wrong folders: the picture beside the document, or in textures/."""
        (self.folder / "in/textures").mkdir(parents=True)
        png.write(self.folder / "in/textures/wood.png", 2, 1, [bytes((188, 128, 240, 20, 220, 30))])
        linked = []
        for link in ("C:/Users/me/wood.png", "file:///home/me/tex/wood.png", "lost/WOOD.PNG", "textures/wood.png"):
            scene = self.write("in/a.dae", self.textured(link))
            out = self.converted(scene, "out/b.dae")
            linked.append(re.search("(?s)<image .*?<init_from>(.*?)<", out.read_text()).group(1))
            self.assertIn("<init_from>wood</init_from>", out.read_text())  # an image's id is no file
            self.assertNotIn("FILE_MISSING", str(render("--list", "materials", out)))
            self.assertEqual(self.picture(out), self.picture(scene))
        self.assertEqual(linked, ["../in/textures/wood.png"] * 4)
        # Through a link of the file system ".." leads elsewhere.
        (self.folder / "far/away").mkdir(parents=True)
        (self.folder / "near").symlink_to(self.folder / "far/away")
        for source in (scene, self.converted(scene, "a.glb")):
            out = self.converted(source, "near/c.dae")
            self.assertEqual(self.picture(out), self.picture(source))

    def test_a_missing_picture_is_told(self):
        scene = self.write("a.dae", self.textured("none/wood.png"))
        self.expect(convert(scene, self.folder / "out/b.dae"), 0, "FILE_MISSING", "none/wood.png")
        self.expect(convert(scene, self.folder / "out/c.dae", "--strict"), 5, "FILE_MISSING")
        self.assertFalse((self.folder / "out/c.dae").exists())

    def test_textures_are_copied_beside_the_output(self):
        (self.folder / "in/tex").mkdir(parents=True)
        png.write(self.folder / "in/tex/wood.png", 2, 1, [bytes((188, 128, 240, 20, 220, 30))])
        wood = (self.folder / "in/tex/wood.png").read_bytes()
        scene = self.write("in/a.dae", self.textured("tex/wood.png"))
        self.write("out/textures/wood.png", "another picture")  # stays
        for source in (scene, self.converted(scene, "a.glb")):
            for _ in range(2):  # the second finds the picture there
                out = self.converted(source, "out/b.dae", "--copy-textures")
            name = re.search("(?s)<image .*?<init_from>(.*?)<", out.read_text()).group(1)
            self.assertTrue(name.startswith("textures/"), name)
            self.assertEqual((self.folder / "out" / name).read_bytes(), wood)
            (self.folder / "out").rename(self.folder / "moved")
            self.assertLess(self.difference(self.picture(self.folder / "moved/b.dae"), self.picture(source)), SAME)
            (self.folder / "moved").rename(self.folder / "out")
        self.assertEqual((self.folder / "out/textures/wood.png").read_text(), "another picture")
        self.assertLessEqual(len(list((self.folder / "out").rglob("*.*"))), 4)
        self.expect(convert(scene, self.folder / "o.glb", "--copy-textures"), 2, "--copy-textures")

    def test_files_that_rsl_names_are_linked_and_copied(self):
        """Of a literal, of a parameter's default and of a <string>; in CDATA and in escaped text."""
        (self.folder / "in/tex").mkdir(parents=True)
        for name, color in (("wood", (200, 90, 30)), ("stone", (90, 120, 200)), ("moss", (40, 180, 60))):
            png.write(self.folder / f"in/tex/{name}.png", 1, 1, [bytes(color)])
        code = """// "tex/wood.png" stays here
surface s(string map = "tex/wood.png"; string other = "";) {
    float on = 1 < 2 && N . N > 0 ? 1 : 0;
    string none = "tex/none.png"; /* "tex/wood.png" */
    if (none != "tex/none.png") printf("gone");
    Ci = on * (color texture(map) + 0.5 * color texture(other) + 0.3 * color texture("tex/moss.png"));
}"""
        def scene_of(code):
            effect = ('<effect id="red-fx"><newparam sid="o"><string>tex/stone.png</string></newparam><profile_RSL>'
                      f'<technique sid="t"><code>{code}</code><pass><shader stage="SURFACE"><bind symbol="other"><param ref="o"/>'
                      "</bind></shader></pass></technique></profile_RSL></effect>")
            return re.sub(r'(?s)<effect id="red-fx">.*?</effect>', lambda match: effect, mesh_scene())
        escaped = code.replace("&", "&amp;").replace("<", "&lt;").replace('"', "&quot;")
        for kind, text in (("cdata", f"<![CDATA[{code}]]>"), ("escaped", escaped)):
            scene = self.write(f"in/{kind}.dae", scene_of(text))
            before = self.picture(scene)
            self.assertGreater(sum(map(sum, before[2])), 1000)
            out = self.converted(scene, "out/deep/b.dae")
            self.assertEqual(self.picture(out), before)
            written = out.read_text().replace("&quot;", '"')
            for name in ('"../../in/tex/wood.png"', "<string>../../in/tex/stone.png<", '"../../in/tex/moss.png"',
                         '// "tex/wood.png" stays', '/* "tex/wood.png" */', '!= "tex/none.png"'):
                self.assertIn(name, written)
            self.assertEqual(self.converted(scene, "in/c.dae").read_text().count("tex/wood.png"),
                             scene.read_text().count("tex/wood.png"))
            copied = self.converted(scene, "own/b.dae", "--copy-textures")
            self.assertEqual(sorted(f.name for f in (self.folder / "own/textures").iterdir()), ["moss.png", "stone.png", "wood.png"])
            (self.folder / "own").rename(self.folder / "else")
            (self.folder / "in/tex").rename(self.folder / "in/hidden")
            self.assertEqual(self.picture(self.folder / "else/b.dae"), before)
            (self.folder / "in/hidden").rename(self.folder / "in/tex")
            shutil.rmtree(self.folder / "else")
            self.assertTrue(copied)
            binary = self.converted(scene, "out/deeper/down/b.glb")
            self.assertEqual(self.picture(binary), before)
            self.assertIn("../../../in/tex/moss.png", str(glb_json(binary)))
            self.assertLess(self.difference(self.picture(self.converted(binary, "back.dae")), before), SAME)

    def test_a_file_of_code_that_names_pictures_comes_in(self):
        """Its names are looked for beside the document. Code that names no file stays where it is."""
        (self.folder / "in/tex").mkdir(parents=True)
        (self.folder / "in/sl").mkdir()
        png.write(self.folder / "in/tex/wood.png", 1, 1, [bytes((200, 90, 30))])
        self.write("in/sl/half.h", "float half(float x) { float a[1]; a[0] = x; return a[0]>0 ? 0.5 * x : 0; }\n")
        used = 'surface s() { float a[2], b[1]; b[0] = 1; if (a[b[0]]>1) Ci = 0; Ci = half(1) * color texture("tex/wood.png"); }'
        self.write("in/sl/names.sl", '#include "half.h"\n' + used)
        self.write("in/sl/plain.sl", '#include "half.h"\nsurface s() { Ci = half(1); }')
        for name in ("names", "plain"):
            effect = ('<effect id="red-fx"><profile_RSL><technique sid="t">'
                      f'<include sid="i" url="sl/{name}.sl"/><pass><shader stage="SURFACE"/></pass></technique></profile_RSL></effect>')
            scene = self.write(f"in/{name}.dae", re.sub(r'(?s)<effect id="red-fx">.*?</effect>', effect, mesh_scene()))
            before = self.picture(scene)
            self.assertGreater(sum(map(sum, before[2])), 1000)
            above = self.converted(scene, f"{name}.dae")
            self.assertEqual(self.picture(above), before)
            self.assertEqual("<include" in above.read_text(), name == "plain")
            self.assertIn("<include", self.converted(scene, f"in/again_{name}.dae").read_text())
        self.assertIn('texture("in/tex/wood.png")', (self.folder / "names.dae").read_text())
        self.assertIn('#include "in/sl/half.h"', (self.folder / "names.dae").read_text())

    def test_a_header_that_names_pictures_comes_in(self):
        """Also through another header, and where it includes itself; in CDATA and as escaped text."""
        for folder in ("tex", "sl"): (self.folder / "in" / folder).mkdir(parents=True)
        png.write(self.folder / "in/tex/wood.png", 1, 1, [bytes((200, 90, 30))])
        self.write("in/sl/inner.h", '#ifndef INNER\n#define INNER\n#include "inner.h"\n#define WOOD "tex/wood.png" // "\n#endif')
        self.write("in/sl/wood.h", '#include "inner.h"\n/* #include "inner.h" */\nfloat one(float x) { float a[2], b[1]; a[0] = x; b[0] = 0;'
                                   ' return a[b[0]]>5 ? x : 1; }\n')
        self.write("in/sl/plain.h", "#define HALF 0.5\n")
        code = '#include "sl/plain.h"\n#include "sl/wood.h" // wood\nsurface s() { Ci = HALF * one(1) * color texture(WOOD); }\n'
        for name, written in ("section", f"<![CDATA[{code}]]>"), ("escaped", code.replace(">", "&gt;").replace("<", "&lt;")):
            effect = ('<effect id="red-fx"><profile_RSL><technique sid="t">'
                      f'<code>{written}</code><pass><shader stage="SURFACE"/></pass></technique></profile_RSL></effect>')
            scene = self.write(f"in/{name}.dae", re.sub(r'(?s)<effect id="red-fx">.*?</effect>', lambda _: effect, mesh_scene()))
            before = self.picture(scene)
            self.assertGreater(sum(map(sum, before[2])), 1000)
            moved = self.converted(scene, f"{name}.dae")
            self.assertEqual(self.picture(moved), before)
            self.assertIn('"in/tex/wood.png"', moved.read_text())
            self.assertIn('#include "in/sl/plain.h"', moved.read_text())
            self.assertIn('#include "sl/wood.h"', self.converted(scene, f"in/again_{name}.dae").read_text())

    def test_links_to_documents_outside_the_new_folder_are_told(self):
        self.write("parts/p.dae", mesh_scene())
        scene = self.write("a.dae", mesh_scene("<library_nodes><node id=\"o\">"
                                               "<instance_node url=\"parts/p.dae#x\"/></node></library_nodes>"))
        out = self.folder / "deep/er/b.dae"
        self.expect(convert(scene, out), 0, "1 of the files it links to", "'../../parts/p.dae'", "--allow-external")

    def test_links_are_moved_from_where_xml_base_says_they_are(self):
        body = "<library_images><image id=\"i\"><init_from>a.png</init_from></image></library_images>"
        self.write("in/tex/a.png", "x")
        scene = self.write("in/a.dae", mesh_scene(body).replace(' version="1.4', ' xml:base="tex/" version="1.4'))
        text = self.converted(scene, "out/b.dae").read_text()
        self.assertIn("<init_from>../in/tex/a.png</init_from>", text)
        self.assertNotIn("xml:base", text)
        self.assertIn('xml:base="tex/"', self.converted(scene, "in/c.dae").read_text())

    def test_all_links_of_the_element_table_are_moved(self):
        body = """<library_controllers><controller id="k"><skin source="it&apos;s.dae#g"/></controller></library_controllers>
<library_nodes><node id="x"><instance_controller url='it&apos;s.dae#k'><skeleton>rig.dae#j</skeleton><skeleton>#n</skeleton>
</instance_controller></node></library_nodes>
<library_physics_models><physics_model id="pm"><rigid_body sid="rb"><technique_common/></rigid_body></physics_model>
</library_physics_models>
<library_physics_scenes><physics_scene id="ps"><instance_physics_model url="rig.dae#pm" parent="rig.dae#j"/></physics_scene>
</library_physics_scenes>"""
        text = mesh_scene(body).replace("<mesh>", '<convex_mesh convex_hull_of="rig.dae#g"/><mesh>').replace(
            "</visual_scene>", '<evaluate_scene><render camera_node="rig.dae#j"/></evaluate_scene></visual_scene>').replace(
            "</asset>", "<contributor><source_data>rig.max</source_data></contributor></asset>")
        out = self.converted(self.write("a.dae", text), "deep/b.dae").read_text()
        self.assertEqual(re.findall(r"(?<!/)(?:rig|it's)\.dae", out), [])
        for link in ('"../it\'s.dae#g"', '"../it\'s.dae#k"', "<skeleton>../rig.dae#j<", "<skeleton>#n<", 'url="../rig.dae#pm"',
                     'parent="../rig.dae#j"', 'convex_hull_of="../rig.dae#g"', 'camera_node="../rig.dae#j"', ">rig.max<"):
            self.assertIn(link, out)

    def test_headers_of_shader_code_are_found_again(self):
        self.write("in/x.h", "#define RED color(1, 0, 0)\n")
        code = '#include "x.h"\nsurface s() { Ci = RED; Oi = 1; }\n'
        effect = (f'<effect id="e"><profile_RSL><technique sid="t"><code>{{}}</code><pass><shader stage="SURFACE">'
                  "<name>s</name></shader></pass></technique></profile_RSL></effect>")
        for name, text in (("cdata", f"<![CDATA[{code}]]>"), ("plain", code.replace("<", "&lt;"))):
            scene = self.write(f"in/{name}.dae", mesh_scene(effects=effect.format(text)).replace('"#red-fx"', '"#e"'))
            out = self.converted(scene, f"o&ut/{name}/b.dae")
            self.assertEqual(self.picture(out, "--allow-external", self.folder), self.picture(scene))
            again = self.converted(out, f"in/again_{name}.dae")
            self.assertIn('#include "x.h"', again.read_text())

    def test_comments_and_private_data_stay(self):
        body = '<!-- keep me -->\n<library_nodes><node id="x"><extra><technique profile="v"><a b="1">&lt;2</a>' \
               "</technique></extra></node></library_nodes>"
        text = self.converted(self.write("a.dae", mesh_scene(body)), "b.dae").read_text()
        self.assertIn("<!-- keep me -->", text)
        self.assertIn('<a b="1">&lt;2</a>', text)


class ExitCodes(Convert):
    def test_they_say_what_went_wrong(self):
        out = self.folder / "o.glb"
        self.expect(convert("--help"), 0, "Exit codes", "--shader")
        self.expect(convert("--version"), 0, "kinora-convert")
        self.expect(convert(MATTE), 2)
        self.expect(convert(MATTE, self.folder / "o.obj"), 2, ".glb")
        self.expect(convert(MATTE, out, "--unit", "2"), 2, "metres")
        self.expect(convert(MATTE, out, "--shader", "x"), 2, "MATERIAL=FILE.sl")
        self.expect(convert(self.folder / "none.dae", out), 3)
        self.expect(convert(self.write("cut.dae", "<COLLADA><asset>"), self.folder / "o.dae"), 3)
        bad = self.write("bad.sl", "surface s( { Ci = ; }")
        for target in ("o.glb", "o.dae"):
            self.expect(convert(MATTE, self.folder / target, "--shader", f"*={bad}"), 4, "bad.sl")
            self.expect(convert(MATTE, self.folder / target, "--shader", f"none={SHADERS / 'matte.sl'}"), 2)
        self.expect(convert(MATTE, "/proc/none/o.glb"), 6)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ["bad.sl", "cut.dae"])

    def test_strict_fails_where_something_is_lost(self):
        light = """<library_lights><light id="l"><technique_common><directional><color sid="c">1 1 1</color>
</directional></technique_common></light></library_lights><library_animations><animation id="a">
<source id="i"><float_array id="ia" count="2">-1 1</float_array><technique_common><accessor source="#ia" count="2">
<param name="TIME" type="float"/></accessor></technique_common></source><source id="o"><float_array id="oa" count="2">0 1</float_array>
<technique_common><accessor source="#oa" count="2"><param name="R" type="float"/></accessor></technique_common></source>
<sampler id="s"><input semantic="INPUT" source="#i"/><input semantic="OUTPUT" source="#o"/></sampler>
<channel source="#s" target="l/c.R"/></animation></library_animations>"""
        text = mesh_scene(light).replace("</instance_geometry>", '</instance_geometry><instance_light url="#l"/>')
        scene = self.write("a.dae", text)
        out = self.folder / "a.glb"
        self.expect(convert(scene, out), 0, "CONVERT_LOST", "before time 0")
        self.expect(convert(scene, out, "--strict"), 1, "CONVERT_LOST")
        self.expect(convert(self.write("b.dae", mesh_scene()), out, "--strict"), 0)
        self.assertTrue(out.exists())


class ToGlb(Convert):
    def test_what_gltf_cannot_move_is_named_as_lost(self):
        moves = """<library_animations><animation id="a">
<source id="i"><float_array id="ia" count="2">0 1</float_array><technique_common><accessor source="#ia" count="2">
<param name="TIME" type="float"/></accessor></technique_common></source><source id="o"><float_array id="oa" count="2">0 40</float_array>
<technique_common><accessor source="#oa" count="2"><param name="ANGLE" type="float"/></accessor></technique_common></source>
<sampler id="s"{0}><input semantic="INPUT" source="#i"/><input semantic="OUTPUT" source="#o"/></sampler>
<channel source="#s" target="n/{1}.ANGLE"/></animation></library_animations>"""
        cases = {"shear": ("", "k"), "beyond": (' post_behavior="CYCLE"', "r"), None: ("", "r")}
        for word, (behaviour, target) in cases.items():
            with self.subTest(word):
                text = mesh_scene(moves.format(behaviour, target)).replace('version="1.4.1"', 'version="1.5.0"').replace(
                    "2005/11", "2008/03").replace('<rotate sid="r">', '<skew sid="k">0 1 0 0 0 1 0</skew><rotate sid="r">')
                scene = self.write("a.dae", text)
                result = convert(scene, self.folder / "a.glb", "--strict")
                if word:
                    self.expect(result, 1, "CONVERT_LOST", word)
                else:
                    self.expect(result, 0)

    def test_vertices_are_shared_and_flat_faces_need_no_normals(self):
        json_ = glb_json(self.converted(SCENES / "matte.dae", "m.glb"))
        primitive = json_["meshes"][0]["primitives"][0]
        accessor = json_["accessors"]
        self.assertEqual(accessor[primitive["attributes"]["POSITION"]]["count"], 6)  # an octahedron
        self.assertNotIn("NORMAL", primitive["attributes"])  # glTF 2.0, 3.7.2.1: flat there, too
        self.assertEqual(accessor[primitive["indices"]]["count"], 24)
        self.assertIn("surface matte", json_["materials"][0]["extras"]["kinora_rsl"]["surface"]["code"])

    def test_one_animated_axis_and_place_are_exact(self):
        body = """<library_animations><animation id="a"><source id="i"><float_array id="ia" count="3">0 1 2.5</float_array>
<technique_common><accessor source="#ia" count="3"><param name="TIME" type="float"/></accessor></technique_common></source>
<source id="o"><float_array id="oa" count="3">0 720 -90</float_array><technique_common><accessor source="#oa" count="3">
<param name="ANGLE" type="float"/></accessor></technique_common></source><sampler id="s"><input semantic="INPUT" source="#i"/>
<input semantic="OUTPUT" source="#o"/></sampler><channel source="#s" target="n/r.ANGLE"/>
<channel source="#s" target="n/t.X"/></animation></library_animations>"""
        result = convert(self.write("a.dae", mesh_scene(body)), self.folder / "a.glb", "-v")
        self.expect(result, 0)
        self.assertNotIn("CONVERT_SAMPLED", result.err)
        json_ = glb_json(self.folder / "a.glb")
        paths = {c["target"]["path"]: json_["animations"][0]["samplers"][c["sampler"]]
                 for c in json_["animations"][0]["channels"]}
        self.assertEqual(set(paths), {"translation", "rotation"})
        self.assertEqual(json_["accessors"][paths["translation"]["input"]]["count"], 3)
        # Two turns in the first second, 810 degrees back in the next 1.5: keys 90 degrees apart.
        self.assertEqual(json_["accessors"][paths["rotation"]["input"]]["count"], 1 + 8 + 9)

    def test_cubics_at_the_thirds_are_cubic_splines(self):
        # HERMITE from 0 to 1 in two seconds, leaving with 2 a segment, arriving level: 3/4 midway.
        source = """<source id="{0}"><float_array id="{0}a" count="2">{1}</float_array><technique_common>
<accessor source="#{0}a" count="2"><param name="{2}" type="float"/></accessor></technique_common></source>"""
        body = "<library_animations><animation id='a'>" + "".join(
            source.format(*row) for row in (("i", "0 2", "TIME"), ("o", "0 1", "X"), ("it", "0 0", "X"),
                                            ("ot", "2 0", "X"))) + """
<source id="k"><Name_array id="ka" count="2">HERMITE HERMITE</Name_array><technique_common><accessor source="#ka" count="2">
<param name="INTERPOLATION" type="name"/></accessor></technique_common></source><sampler id="s"><input semantic="INPUT" source="#i"/>
<input semantic="OUTPUT" source="#o"/><input semantic="INTERPOLATION" source="#k"/><input semantic="IN_TANGENT" source="#it"/>
<input semantic="OUT_TANGENT" source="#ot"/></sampler><channel source="#s" target="n/t.X"/>
<channel source="#s" target="n/r.ANGLE"/></animation></library_animations>"""
        out = self.converted(self.write("a.dae", mesh_scene(body)), "a.glb")
        json_ = glb_json(out)
        channels = {c["target"]["path"]: json_["animations"][0]["samplers"][c["sampler"]]
                    for c in json_["animations"][0]["channels"]}
        self.assertEqual(channels["translation"]["interpolation"], "CUBICSPLINE")
        self.assertEqual(channels["rotation"]["interpolation"], "LINEAR")  # sampled
        x = self.floats(out, json_, channels["translation"]["output"])[0::3]
        # glTF 2.0, appendix C: in tangent, value, out tangent; tangents times the duration.
        midway = 0.5 * x[1] + 0.125 * 2 * x[2] + 0.5 * x[4] - 0.125 * 2 * x[3]
        self.assertAlmostEqual(midway, 0.75, 6)
        angles = self.floats(out, json_, channels["rotation"]["output"])
        times = self.floats(out, json_, channels["rotation"]["input"])
        turned = lambda q: 2 * math.degrees(math.atan2(q[1], q[3]))
        for k, time in enumerate(times):
            s = time / 2
            angle = 2 * (s**3 - 2 * s**2 + s) + 3 * s**2 - 2 * s**3
            self.assertAlmostEqual(turned(angles[4 * k:4 * k + 4]), angle, 4)

    def floats(self, path, json_, index):
        data = path.read_bytes()
        start = 20 + struct.unpack("<I", data[12:16])[0] + 8
        accessor = json_["accessors"][index]
        view = json_["bufferViews"][accessor["bufferView"]]
        count = accessor["count"] * {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        return struct.unpack_from(f"<{count}f", data, start + view["byteOffset"])

    def test_gltf_is_the_same_in_two_files(self):
        out = self.converted(SCENES / "matte.dae", "m.gltf")
        json_ = json.loads(out.read_text())
        self.assertEqual(json_["buffers"][0]["uri"], "m.bin")
        self.assertEqual((self.folder / "m.bin").stat().st_size, json_["buffers"][0]["byteLength"])

    # The pictures are those of the .dae: what pbrMetallicRoughness cannot say is read from extras.
    # (Not scenes without materials, which get each format's own default.)
    PICTURES = [("court.dae", 1), ("walker.dae", 0.7), ("tintoy.dae", 1.2)]
    SHARED_PICTURES = [
        ("cts_skin_2_influence/skin_2_influence.dae", 0.5), ("cts_skin_on_morph/skin_on_morph.dae", 0),
        ("gltf_rigged_figure/RiggedFigure.dae", 0.6), ("thinmatrix_cowboy/model.dae", 0.4),
        ("webglue_cat/cat.dae", 0), ("torque_grenade_bezier/*.dae", 0.5), ("cts_anim_1anim_bezier/*.dae", 1.3),
        ("cts_transparent_rgb_zero/*.dae", 0), ("cts_x_up/*.dae", 0), ("cts_transform_stack/*.dae", 0.5),
        ("cts_morph_two_targets_relative/*.dae", 0), ("cts_bind_vertex_input_texture_set/*.dae", 0),
        ("cts_instances_of_same_node/*.dae", 0), ("cts_anim_target_matrix_30/*.dae", 1),
        ("cts_spot_falloff/*.dae", 0)]

    def test_pictures_are_those_of_the_original(self):
        scenes = [(SCENES / name, time) for name, time in self.PICTURES]
        for pattern, time in self.SHARED_PICTURES if SHARED_SCENES else []:
            scenes += [(path, time) for path in sorted(SHARED_SCENES.glob(pattern))]
        for scene, time in scenes:
            with self.subTest(scene.name):
                out = self.converted(scene, f"{scene.stem}.glb")
                before = self.picture(scene, "--time", time)
                after = self.picture(out, "--time", time)
                self.assertLess(self.difference(before, after), LIKE)
        self.whole_if(SHARED_SCENES)

    def test_what_has_no_material_and_how_textures_are_filtered_stay(self):
        pairs = TEST_DATA / "conformance/differ"
        bare = self.write("bare.dae", re.sub(r"<bind_material>.*?</bind_material>", "", mesh_scene(), flags=re.S))
        for scene in [bare, *sorted((pairs / "minifications").glob("*.dae")), *sorted((pairs / "wraps").glob("*.dae"))]:
            with self.subTest(scene.name):
                out = self.converted(scene, f"{scene.stem}.glb")
                self.assertLess(self.difference(self.picture(scene), self.picture(out)), LIKE)
        filters = {self.filters(self.folder / f"{name}.glb") for name in
                   ("nearest", "linear", "nearest_mipmap_nearest", "linear_mipmap_linear")}
        self.assertEqual(filters, {9728, 9729, 9984, 9987})

    def filters(self, path):
        return glb_json(path)["samplers"][0]["minFilter"]

    def test_back_to_collada_the_pictures_stay(self):
        scenes = [(SCENES / name, time) for name, time in self.PICTURES[:1]]
        for pattern, time in self.SHARED_PICTURES[:6] if SHARED_SCENES else []:
            scenes += [(path, time) for path in sorted(SHARED_SCENES.glob(pattern))]
        for scene, time in scenes:
            with self.subTest(scene.name):
                glb = self.converted(scene, f"{scene.stem}.glb")
                out = self.converted(glb, f"{scene.stem}.dae")
                self.assertEqual(out.read_bytes(), self.converted(out, "again.dae").read_bytes())
                # The range of keys that move nothing is lost, and an added camera frames the range.
                self.assertLess(self.difference(self.picture(scene, "--time", time, spp=16),
                                                self.picture(out, "--time", time, spp=16)), LIKE)
        self.whole_if(SHARED_SCENES)

    def test_maps_of_normals_and_morph_normals_survive_in_collada(self):
        """A wall whose normal map leans it to the light, with a target that turns its normals."""
        def data(kind, payload):
            return f"data:{kind};base64,{base64.b64encode(payload).decode()}"
        floats = [-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0] + [0, 0, 1] * 4 + [0, 1, 1, 1, 1, 0, 0, 0] \
            + [0, 0, 0.2] * 4 + [-0.6, 0, -0.2] * 4
        indices = struct.pack("<6H", 0, 1, 2, 0, 2, 3)
        blob = struct.pack(f"<{len(floats)}f", *floats) + indices
        image = self.folder / "lean.png"
        png.write(image, 1, 1, [bytes((188, 128, 240))])
        views = [(0, 48), (48, 48), (96, 32), (128, 48), (176, 48), (224, 12)]
        kinds = ["VEC3", "VEC3", "VEC2", "VEC3", "VEC3", "SCALAR"]
        tree = {
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
            "extensionsUsed": ["KHR_lights_punctual"],
            "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": 3}]}},
            "buffers": [{"byteLength": len(blob), "uri": data("application/octet-stream", blob)}],
            "bufferViews": [{"buffer": 0, "byteOffset": at, "byteLength": n} for at, n in views],
            "accessors": [{"bufferView": i, "componentType": 5123 if i == 5 else 5126,
                           "count": 6 if i == 5 else 4, "type": kind,
                           **({"min": [-1, -1, 0], "max": [1, 1, 0]} if i == 0 else {})}
                          for i, kind in enumerate(kinds)],
            "images": [{"uri": data("image/png", image.read_bytes())}], "textures": [{"source": 0}],
            "materials": [{"name": "wall", "normalTexture": {"index": 0},
                           "pbrMetallicRoughness": {"metallicFactor": 0}}],
            "meshes": [{"name": "wall", "weights": [0.5], "primitives": [{
                "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 5, "material": 0,
                "targets": [{"POSITION": 3, "NORMAL": 4}]}]}],
            "cameras": [{"type": "perspective", "perspective": {"yfov": 0.6, "znear": 0.1}}],
            "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 5]},
                      {"rotation": [0, 0.3, 0, 0.954], "extensions": {"KHR_lights_punctual": {"light": 0}}}]}
        scene = self.folder / "wall.gltf"
        scene.write_text(json.dumps(tree))
        plain = self.picture(scene)
        # <blinn> comes near glTF's material: its diffuse light is not less by what is reflected (4 %).
        self.assertLess(self.difference(plain, self.picture(self.converted(scene, "wall.dae"))), 1.5 * LIKE)
        for part in ("normalTexture", "targets"):  # they are seen in the picture
            owner = tree["materials"][0] if part == "normalTexture" else tree["meshes"][0]["primitives"][0]
            kept = owner.pop(part)
            (self.folder / "without.gltf").write_text(json.dumps(tree))
            self.assertGreater(self.difference(plain, self.picture(self.folder / "without.gltf")), 3 * LIKE)
            owner[part] = kept
        text = (self.folder / "wall.dae").read_text()
        self.assertIn('bumptype="NORMALMAP"', text)
        self.assertNotIn("profile_RSL", text)
        self.assertNotIn('triangles count="0"', text)

    def test_an_archive_brings_its_files(self):
        body = '<library_images><image id="i"><init_from>pictures/a.png</init_from></image></library_images>'
        archive = self.folder / "a.zae"
        with zipfile.ZipFile(archive, "w") as zip_:
            zip_.writestr("scene/a.dae", mesh_scene(body))
            zip_.writestr("scene/pictures/a.png", "x")
        out = self.converted(archive, "b.dae")
        self.assertIn("<init_from>b_files/scene/pictures/a.png</init_from>", out.read_text())
        self.assertEqual((self.folder / "b_files/scene/pictures/a.png").read_text(), "x")

    def test_blender_sees_the_same_outlines(self):
        if not blender_writes_gltf() or not SHARED_SCENES:
            self.skipTest("no blender with numpy, or no shared scenes")
        words, originals = [], []
        for scene, time in (("cts_skin_2_influence/skin_2_influence.dae", 0.5),
                            ("cts_instances_of_same_node/*.dae", 0), ("cts_lookat/*.dae", 0)):
            scene = next(SHARED_SCENES.glob(scene))
            out = self.converted(scene, f"{scene.stem}.glb")
            words += [out, str(time), self.folder / f"{scene.stem}-blender.png"]
            originals.append((scene, time))
        done = subprocess.run(["blender", "-b", "-P", SOURCE / "tests/programs/convert/blender_glb.py", "--",
                               "192", "192", *map(str, words)], capture_output=True, text=True, timeout=240,
                              env={**os.environ, "PATH": "/usr/bin:/bin"})  # Debian's python, which has numpy
        for scene, time in originals:
            with self.subTest(scene.name):
                ours = self.folder / f"{scene.stem}-ours.png"
                self.expect(render(scene, "-o", ours, "--size", "192x192", "--spp", "16", "--time", time,
                                   "--progress", "none"), 0)
                theirs = self.folder / f"{scene.stem}-blender.png"
                self.assertTrue(theirs.exists(), done.stdout[-2000:] + done.stderr[-2000:])
                a, b = outline(ours), outline(theirs)
                both = sum(x and y for x, y in zip(a, b))
                either = sum(x or y for x, y in zip(a, b))
                self.assertGreater(both, 100)
                self.assertGreater(both / either, 0.97)

    def scenes(self):
        scenes = sorted(SCENES.glob("*.dae"))
        if SHARED_SCENES:
            scenes += sorted(p for p in SHARED_SCENES.glob("*/*.dae"))
        return scenes

    def test_every_scene_converts_and_the_validator_finds_no_error(self):
        made = []
        for scene in self.scenes():
            with self.subTest(str(scene)):
                name = f"{scene.parent.name}-{scene.stem}"
                result = convert(scene, self.folder / f"{name}.glb", "-q")
                self.assertIn(result.code, (0, 3), result)  # 3: no scene in it
                if result.code == 0:
                    made.append(self.folder / f"{name}.glb")
                self.assertIn(convert(scene, self.folder / f"{name}.dae", "-q").code, (0, 3))
        self.assertGreaterEqual(len(made), 5)
        reports = validated(made)
        if reports is None:
            self.skipTest("glTF-Validator is not installed (scripts/npm_packages)")
        for name, report in reports.items():
            with self.subTest(name):
                self.assertEqual(report["errors"], 0,
                                 [m for m in report["messages"] if m["severity"] == 0][:5])
        self.whole_if(SHARED_SCENES)


if __name__ == "__main__":
    programs.main()
