"""tests/programs/convert/convert_gltf_test.py: what glTF and COLLADA say in their own ways, through
kinora-convert: attributes, materials, clips, skins, texts; pictures before and after."""
import base64
import copy
import itertools
import json
import math
import os
import re
import shutil
import struct
import subprocess
import unittest
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import programs
import schema_agreement_test
import written_scenes as scenes
from convert_test import PICTURE, SAME, Convert, convert, glb_json, mesh_scene, png, validated
from programs import render

sys.path.insert(0, str(programs.SOURCE / "tests/conformance"))
import dae  # noqa: E402

SCHEMA = 'xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"'


class Gltf:
    """A triangle before an orthographic camera, its buffer as a data URI."""

    def __init__(self, **material):
        self.bytes = b""
        self.views, self.accessors = [], []
        self.attributes = {"POSITION": self.floats("VEC3", [-1, -1, 0, 1, -1, 0, 0, 1, 0], bounds=True),
                           "NORMAL": self.floats("VEC3", [0, 0, 1] * 3)}
        self.tree = {
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
            "cameras": [{"type": "orthographic",
                         "orthographic": {"xmag": 1.5, "ymag": 1.5, "znear": 0.1, "zfar": 100}}],
            "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0, 5]}],
            "meshes": [{"primitives": [{"attributes": self.attributes}]}]}
        if material:
            self.tree["materials"] = [material]
            self.tree["meshes"][0]["primitives"][0]["material"] = 0
            if "extensions" in material:
                self.tree["extensionsUsed"] = list(material["extensions"])

    def view(self, payload):
        self.bytes += b"\0" * (-len(self.bytes) % 4)
        self.views.append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(payload)})
        self.bytes += payload
        return len(self.views) - 1

    def floats(self, kind, numbers, bounds=False):
        width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[kind]
        accessor = {"bufferView": self.view(struct.pack(f"<{len(numbers)}f", *numbers)),
                    "componentType": 5126, "count": len(numbers) // width, "type": kind}
        if bounds:
            accessor["min"] = [min(numbers[i::width]) for i in range(width)]
            accessor["max"] = [max(numbers[i::width]) for i in range(width)]
        self.accessors.append(accessor)
        return len(self.accessors) - 1

    def text(self, padding=b""):
        uri = "data:application/octet-stream;base64," + base64.b64encode(self.bytes + padding).decode()
        return json.dumps({**self.tree, "bufferViews": self.views, "accessors": self.accessors,
                           "buffers": [{"byteLength": len(self.bytes), "uri": uri}]})


UNLIT = {"KHR_materials_unlit": {}}


class GltfConvert(Convert):
    def save(self, name, gltf):
        return self.write(f"{name}.gltf", gltf if isinstance(gltf, str) else gltf.text())

    def image(self, name, texels):
        side = int(len(texels) ** 0.5)
        rows = [b"".join(map(bytes, texels[y * side:(y + 1) * side])) for y in range(side)]
        png.write(self.folder / name, side, side, rows)
        return self.folder / name

    def picture(self, scene, *words):
        out = self.folder / f"{scene.stem}-{len(list(self.folder.iterdir()))}.png"
        result = render(scene, "-o", out, *PICTURE, *words)
        self.expect(result, 0)
        self.assertNotIn("IMAGE_UNREADABLE", result.err)
        return png.read(out)

    def valid(self, *files):
        for name, report in (validated(files) or {}).items():
            errors = [m for m in report["messages"] if m["severity"] == 0]
            self.assertEqual(errors, [], name)

    def stays(self, scene, *words, times=2):
        """Converts to .glb and that again; all show the same, and nothing is lost."""
        before, at = self.picture(scene, *words), scene
        for k in range(times):
            at = self.converted(at, f"{scene.stem}-{k}.glb", "--strict")
            self.assertLess(self.difference(before, self.picture(at, *words)), SAME)
        self.valid(at)
        return before, at

    def brightest(self, picture, channel):
        return max(max(row[channel::3]) for row in picture[2])

    def shown(self, gltf, name, part):
        """That `part` (a function that takes it away) is seen in the picture at all."""
        less = copy.deepcopy(gltf)
        part(less)
        a, b = self.picture(self.save(name, gltf)), self.picture(self.save(name + "-less", less))
        self.assertGreater(self.difference(a, b), 1)


class Lights(GltfConvert):
    def test_blenders_watts_become_candela_and_lux(self):
        rows = [("<point><color>1000 500 0</color><quadratic_attenuation>0.0016</quadratic_attenuation></point>",
                 "point", 1000 / (4 * math.pi)), ("<directional><color>2 1 0</color></directional>",
                                                          "directional", 2)]
        for kind, type_, intensity in rows:
            lights = (f"<library_lights><light id='l'><technique_common>{kind}</technique_common></light></library_lights>"
                      "<library_nodes><node id='lamp'><translate>1 2 3</translate><instance_light url='#l'/></node>"
                      "</library_nodes>")
            asset = ("<asset><contributor><authoring_tool>Blender 3.4.1 commit date:2022-12-19</authoring_tool>"
                     '</contributor><unit meter="1"/></asset>')
            text = mesh_scene(lights, asset=asset).replace(
                '<visual_scene id="vs">', '<visual_scene id="vs"><node><instance_node url="#lamp"/></node>')
            scene = self.write(f"{type_}.dae", text)
            self.assertIn("LIGHT_WATTS", render(scene, "-o", self.folder / "a.png", *PICTURE).err)
            _, out = self.stays(scene)
            light = glb_json(out)["extensions"]["KHR_lights_punctual"]["lights"][0]
            self.assertEqual(light["type"], type_)
            self.assertTrue(light["extras"]["kinora_blender"])  # for its grey world, which the picture has
            self.assertAlmostEqual(light["intensity"], intensity, 4)


    def test_lights_keep_their_picture_in_every_unit(self):
        """A square lit from 3 units away, whose diffuse light is 0.8 at its middle by hand: 9 / 3^2."""
        kinds = {"point": "<point><color>0.9 0.9 0.9</color>{}</point>",
                 "spot": "<spot><color>0.9 0.9 0.9</color>{}<falloff_angle>60</falloff_angle></spot>"}
        falls = ("<constant_attenuation>0</constant_attenuation><linear_attenuation>0</linear_attenuation>"
                 "<quadratic_attenuation>0.1111111111</quadratic_attenuation>")
        shown = {}
        for kind, meter in itertools.product(kinds, (1, 0.0254, 0.01)):
            with self.subTest(f"{kind} {meter}"):
                lamp = (f'<library_lights><light id="lamp"><technique_common>{kinds[kind].format(falls)}</technique_common>'
                        "</light></library_lights>")
                node = '<node id="ln"><translate>0 0 3</translate><instance_light url="#lamp"/></node>'
                scene = self.write(f"{kind}{meter}.dae", scenes.document(
                    scenes.CAMERA + scenes.geometries(scenes.square()) + scenes.MATTE + lamp,
                    scenes.EYE + scenes.place() + node, meter=meter))
                before = self.picture(scene)
                self.assertGreater(self.brightest(before, 0), 200)
                glb = self.converted(scene, "a.glb")
                self.assertAlmostEqual(glb_json(glb)["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"],
                                       math.pi * 0.7874122 * 9 * meter * meter, 5)
                if kind == "point":  # all of it is glTF's
                    self.assertNotIn("kinora_rsl", str(glb_json(glb)["extensions"]))
                again = self.converted(glb, "b.glb")
                back = self.converted(again, "c.dae")
                for file in (glb, again, back, self.converted(back, "d.glb")):
                    self.assertLess(self.difference(before, self.picture(file)), SAME)
                self.assertEqual(shown.setdefault(kind, before), before)

    def test_gltfs_lights_are_in_metres_below_kinoras_axes(self):
        for kind, more in (("point", {}), ("spot", {"spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.5}})):
            pictures, files = [], []
            for meter in (1, 0.01):
                g = Gltf(pbrMetallicRoughness={"metallicFactor": 0})
                size = 1 / meter
                g.attributes["POSITION"] = g.floats("VEC3", [size * x for x in (-1, -1, 0, 1, -1, 0, 0, 1, 0)], bounds=True)
                lamp = {"type": kind, "intensity": 9 * math.pi / 2, "range": 6, **more}
                g.tree["extensionsUsed"] = ["KHR_lights_punctual"]
                g.tree["extensions"] = {"KHR_lights_punctual": {"lights": [lamp]}}
                g.tree["nodes"][1]["translation"] = [0, 0, 5 * size]
                g.tree["nodes"] += [
                    {"translation": [0, 0, 3 * size], "extensions": {"KHR_lights_punctual": {"light": 0}}},
                    {"children": [0, 1, 2], "scale": [meter] * 3, "extras": {"kinora_axes": {"up": "Y", "meter": meter}}}]
                g.tree["scenes"][0]["nodes"] = [3]
                files.append(self.save(f"{kind}{meter}", g))
                pictures.append(self.picture(files[-1]))
            self.assertGreater(self.brightest(pictures[0], 0), 100)
            self.assertLess(self.difference(*pictures), SAME)
            again = self.converted(files[1], f"{kind}.glb")
            self.assertLess(self.difference(pictures[0], self.picture(again)), SAME)
            written = glb_json(again)["extensions"]["KHR_lights_punctual"]["lights"][0]
            self.assertAlmostEqual(written["intensity"], 9 * math.pi / 2, 9)
            self.assertAlmostEqual(written["range"], 6, 9)
            daes = [self.picture(self.converted(file, f"{file.stem}.dae")) for file in files]
            self.assertLess(self.difference(*daes), SAME)


class Attributes(GltfConvert):
    def test_colors_with_alpha_stay_gltfs_own(self):
        g = Gltf(alphaMode="BLEND", extensions=UNLIT)
        g.attributes["COLOR_0"] = g.floats("VEC4", [1, 0, 0, .2, 0, 1, 0, .5, 0, 0, 1, 1])
        self.shown(g, "colors", lambda less: less.tree["meshes"][0]["primitives"][0]["attributes"].pop("COLOR_0"))
        _, out = self.stays(self.folder / "colors.gltf")
        self.assertEqual(set(glb_json(out)["meshes"][0]["primitives"][0]["attributes"]),
                         {"POSITION", "NORMAL", "COLOR_0"})

    def test_normals_that_a_file_lacks_are_those_of_the_picture(self):
        """Creased ones of a .dae are written; without any, glTF is flat, and the .dae says so."""
        scene = self.write("prism.dae", dae.plain(geometries=dae.prism(12)))
        glb = self.converted(scene, "prism.glb")
        self.assertIn("NORMAL", glb_json(glb)["meshes"][0]["primitives"][0]["attributes"])
        again = self.converted(glb, "prism-again.dae")
        pictures = [self.picture(f) for f in (scene, glb, again)]
        for other in pictures[1:]:
            self.assertLess(self.difference(pictures[0], other), SAME)
        tree = json.loads(self.converted(scene, "flat.gltf").read_text())
        for primitive in tree["meshes"][0]["primitives"]:
            del primitive["attributes"]["NORMAL"]
        flat = self.write("flat.gltf", json.dumps(tree))
        shown = self.picture(flat)
        self.assertGreater(self.difference(pictures[0], shown), 10 * SAME)
        self.assertLess(self.difference(shown, self.picture(self.converted(flat, "flat.dae"))), SAME)
        self.assertLess(self.difference(shown, self.picture(scene, "--smooth", "0")), SAME)

    def test_colors_that_tint_a_common_material_are_gltfs_own(self):
        at = '<input semantic="TEXCOORD" source="#house-t" offset="2" set="0"/>'
        colors = dae.source("house-c", [(k / 8, 1 - k / 8, .5) for k in range(len(dae.FACES))], "RGB")
        mesh = dae.geometry(dae.triangles().replace(at, at + '<input semantic="COLOR" source="#house-c" offset="1"/>')
                            ).replace("<vertices", colors + "<vertices", 1)
        scene = self.write("tint.dae", dae.plain(geometries=mesh))
        glb = self.converted(scene, "tint.glb")
        self.assertIn("COLOR_0", glb_json(glb)["meshes"][0]["primitives"][0]["attributes"])
        again = self.converted(glb, "tint-again.dae")
        pictures = [self.picture(f) for f in (scene, glb, again)]
        for other in pictures[1:]:
            self.assertLess(self.difference(pictures[0], other), SAME)
        self.assertGreater(self.difference(pictures[0], self.picture(scene, "--vertex-colors", "off")), 1)

    def test_tangents_of_a_map_of_normals_stay(self):
        self.image("lean.png", [(250, 128, 180)])
        g = Gltf(normalTexture={"index": 0}, pbrMetallicRoughness={"metallicFactor": 0})
        g.tree.update(images=[{"uri": "lean.png"}], textures=[{"source": 0}])
        g.attributes["TEXCOORD_0"] = g.floats("VEC2", [0, 0, 1, 0, .5, 1])
        g.attributes["TANGENT"] = g.floats("VEC4", [0, 1, 0, 1] * 3)
        self.shown(g, "tangents", lambda less: less.tree["meshes"][0]["primitives"][0]["attributes"].pop("TANGENT"))
        _, out = self.stays(self.folder / "tangents.gltf")
        json_ = glb_json(out)
        primitive = json_["meshes"][0]["primitives"][0]
        self.assertEqual(set(primitive["attributes"]), {"POSITION", "NORMAL", "TEXCOORD_0", "TANGENT"})
        self.assertEqual(json_["accessors"][primitive["attributes"]["TANGENT"]]["count"], 3)
        self.assertNotIn("extras", json_["materials"][0])

    def test_what_shaders_read_has_a_name_of_its_own(self):
        code = "surface s(varying float warmth = 0; varying float HEAT = 0;) { Ci = color(warmth, HEAT, 0); Oi = 1; }"
        g = Gltf(extras={"kinora_rsl": {"surface": {"code": code}, "inputs": {"warmth": "_HEAT_2"}}})
        g.attributes["_HEAT"] = g.floats("SCALAR", [1, .5, 0])
        g.attributes["_HEAT_2"] = g.floats("SCALAR", [0, .5, 1])
        g.attributes["_UNREAD"] = g.floats("SCALAR", [0, .5, 1])
        scene = self.save("heat", g)
        before, out = self.stays(scene)
        self.assertGreater(self.brightest(before, 0), 100)
        self.assertGreater(self.brightest(before, 1), 100)
        self.assertNotIn("_UNREAD", glb_json(out)["meshes"][0]["primitives"][0]["attributes"])

    def test_inputs_of_colladas_meshes_stay(self):
        text = mesh_scene(effects="""<effect id="warm-fx"><profile_COMMON><technique sid="c"><lambert/></technique></profile_COMMON>
<profile_RSL><technique sid="t"><code>surface warm(varying float heat = 0;) { Ci = heat; Oi = 1; }</code>
<pass><shader stage="SURFACE"><name>warm</name></shader></pass></technique></profile_RSL></effect>""")
        text = text.replace('url="#red-fx"', 'url="#warm-fx"').replace(
            "<vertices", """<source id="h"><float_array id="ha" count="3">0 0.5 1</float_array><technique_common>
<accessor source="#ha" count="3"><param name="T" type="float"/></accessor></technique_common></source><vertices""").replace(
            '<p>0 1 2</p>', '<input semantic="HEAT" source="#h" offset="0" set="3"/><p>0 1 2</p>').replace(
            'symbol="m" target="#red"/>',
            'symbol="m" target="#red"><bind_vertex_input semantic="heat" input_semantic="HEAT" input_set="3"/></instance_material>')
        before, out = self.stays(self.write("warm.dae", text))
        self.assertGreater(self.brightest(before, 0), 150)
        self.assertIn("_HEAT", glb_json(out)["meshes"][0]["primitives"][0]["attributes"])
        # Five numbers a vertex are more than an accessor has; none but the first is read.
        wide = text.replace('count="3">0 0.5 1<', 'count="15">' + "0 1 2 3 4 " * 3 + "<").replace(
            'source="#ha" count="3">', 'source="#ha" count="3" stride="5">' + '<param name="A" type="float"/>' * 4)
        result = convert(self.write("wide.dae", wide), self.folder / "wide.glb", "--strict")
        self.expect(result, 1, "CONVERT_LOST", "'HEAT' of 5 numbers")
        self.assertEqual(result.err.count("CONVERT_LOST"), 1)


class Materials(GltfConvert):
    TEXELS = [(255, 0, 0)] * 6 + [(0, 255, 0)] * 5 + [(0, 0, 255)] * 5

    def textured(self, **info):
        g = Gltf(pbrMetallicRoughness={"baseColorTexture": {"index": 0, **info}}, extensions=UNLIT)
        g.attributes["TEXCOORD_0"] = g.floats("VEC2", [0, 0, 1, 0, .5, 1])
        g.tree.update(textures=[{"source": 0, "sampler": 0}], samplers=[{"magFilter": 9728, "minFilter": 9728}])
        return g

    def test_images_inside_the_file_stay_inside(self):
        image = self.image("a.png", self.TEXELS).read_bytes()
        g = self.textured()
        g.tree["images"] = [{"bufferView": g.view(image), "mimeType": "image/png"}]
        scene = self.save("inside", g)
        before, out = self.stays(scene, times=3)
        self.assertGreater(len(set(before[2])), 3)
        self.assertNotIn("extras", glb_json(out)["materials"][0])
        self.assertIn(image, out.read_bytes())

    def test_textures_of_shaders_stay_in_a_glb_of_a_glb(self):
        self.image("a.png", self.TEXELS)
        g = self.textured()
        code = 'surface s(string map = "";) { Ci = color texture(map, s, t); Oi = 1; }'
        g.tree["materials"] = [{"extras": {"kinora_rsl": {"surface": {"code": code, "params": {"map": "a.png"}}}}}]
        del g.tree["textures"], g.tree["samplers"]
        before, _ = self.stays(self.save("shader", g), times=3)
        self.assertGreater(len(set(before[2])), 3)

    def test_lights_in_rsl_stay_in_a_glb_and_back(self):
        code = ('light beam() { illuminate(P, vector "shader" (0.2, 0.1, 1), 0.3) { point p = transform("shader", Ps);'
                " Cl = color(1, 0.5 + 0.5 * xcomp(p), 0.5 + 0.5 * ycomp(p)); } }")
        lamp = (f'<library_effects><effect id="lfx"><profile_RSL><technique sid="t"><code><![CDATA[{code}]]></code>'
                '<pass><shader stage="LIGHT"/></pass></technique></profile_RSL></effect></library_effects>'
                '<library_lights><light id="lamp"><technique_common><point><color>1 1 1</color></point>'
                '</technique_common><extra><technique profile="RSL"><instance_effect url="#lfx"/></technique></extra>'
                "</light></library_lights>")
        node = '<node id="ln"><translate>0 0 3</translate><rotate>0 0 1 20</rotate><instance_light url="#lamp"/></node>'
        for up in ("Y_UP", "Z_UP"):
            with self.subTest(up):
                scene = self.write(f"{up}.dae", scenes.document(
                    scenes.CAMERA + scenes.geometries(scenes.square()) + scenes.MATTE + lamp,
                    scenes.EYE + scenes.place() + node, up=up))
                before, glb = self.stays(scene)
                self.assertGreater(len(set(before[2])), 20)
                back = self.converted(glb, f"{up}-back.dae")
                self.assertLess(self.difference(before, self.picture(back)), SAME)

    def test_other_viewers_see_transforms_of_textures(self):
        self.image("a.png", self.TEXELS)
        for k, (offset, scale, rotation) in enumerate(
                [([.3, .1], [3, 2], .7), ([0, .25], [-1, 2], 0), ([.5, 0], [1, -3], -2.5), ([0, 0], [0, 2], 1)]):
            with self.subTest(k):
                wanted = {"offset": offset, "scale": scale, "rotation": rotation}
                g = self.textured(extensions={"KHR_texture_transform": wanted})
                g.tree["images"] = [{"uri": "a.png"}]
                g.tree["extensionsUsed"].append("KHR_texture_transform")
                _, out = self.stays(self.save(f"placed{k}", g))
                material = glb_json(out)["materials"][0]
                self.assertIn("KHR_texture_transform",
                              material["pbrMetallicRoughness"]["baseColorTexture"]["extensions"])
                self.assertNotIn("extras", material)

    def test_other_viewers_see_all_of_gltfs_material(self):
        material = {"pbrMetallicRoughness": {"baseColorFactor": [.1, .2, .1, .75], "metallicFactor": .25,
                                             "roughnessFactor": .3},
                    "emissiveFactor": [.5, 1, .25], "alphaMode": "MASK", "alphaCutoff": .25, "doubleSided": True,
                    "extensions": {"KHR_materials_specular": {"specularFactor": .5, "specularColorFactor": [1, .5, 2]},
                                   "KHR_materials_ior": {"ior": 2}, "KHR_materials_emissive_strength": {"emissiveStrength": 4}}}
        _, out = self.stays(self.save("all", Gltf(**material)))
        written = glb_json(out)["materials"][0]
        self.assertNotIn("extras", written)

        def near(a, b):
            if isinstance(a, dict):
                for key in a:
                    near(a[key], b[key])
            elif isinstance(a, (list, float, int)) and not isinstance(a, bool):
                for x, y in zip(a, b) if isinstance(a, list) else [(a, b)]:
                    self.assertAlmostEqual(x, y, 6)
            else:
                self.assertEqual(a, b)
        near(material, written)

    def test_a_map_of_specular_color_and_glossiness_stays(self):
        self.image("a.png", self.TEXELS)
        g = Gltf(extensions={"KHR_materials_pbrSpecularGlossiness": {
            "diffuseFactor": [.1, .6, .2, 1], "diffuseTexture": {"index": 0}, "specularFactor": [.5, .25, 1],
            "glossinessFactor": .5, "specularGlossinessTexture": {"index": 0}}})
        g.attributes["TEXCOORD_0"] = g.floats("VEC2", [0, 0, 1, 0, .5, 1])
        g.tree.update(textures=[{"source": 0}], images=[{"uri": "a.png"}])
        scene = self.save("glossy", g)
        _, out = self.stays(scene)
        written = glb_json(out)["materials"][0]
        self.assertIn("specularGlossinessTexture", written["extensions"]["KHR_materials_pbrSpecularGlossiness"])
        self.assertNotIn("KHR_materials_ior", written["extensions"])  # excluded beside it
        self.expect(convert(scene, self.folder / "glossy.dae"), 0, "CONVERT_LOST", "its map of specular color")

    def test_what_glTF_has_no_number_for_is_kept_in_extras(self):
        code = {"library": "gltf_unlit", "params": {"base_color": [2, 0.5, 0.5]}}
        scene = self.save("bright", Gltf(extras={"kinora_rsl": {"surface": code}}))
        _, out = self.stays(scene)
        self.assertIn("extras", glb_json(out)["materials"][0])


class Collada(GltfConvert):
    """From glTF to COLLADA: the nearest profile_COMMON, in display colours."""

    def color(self, text, slot):
        found = re.search(f"<{slot}>\\s*<color[^>]*>([^<]*)</color>", text)
        self.assertTrue(found, f"{slot}: {text}")
        return [float(x) for x in found[1].split()]

    def light(self, **light):
        g = Gltf(pbrMetallicRoughness={"metallicFactor": 0})
        g.tree["extensionsUsed"] = ["KHR_lights_punctual"]
        g.tree["extensions"] = {"KHR_lights_punctual": {"lights": [light]}}
        g.tree["nodes"].append({"translation": [0, 0, 3], "extensions": {"KHR_lights_punctual": {"light": 0}}})
        g.tree["scenes"][0]["nodes"].append(2)
        return g

    def test_a_light_of_intensity_1000_survives(self):
        cone = {"innerConeAngle": 0.4, "outerConeAngle": 0.4}
        for kind, more in (("point", {}), ("directional", {}), ("spot", {"spot": cone})):
            with self.subTest(kind):
                g = self.light(type=kind, intensity=1000, color=[1, 0.5, 0.25], **more)
                first = self.converted(self.save(kind, g), f"{kind}.glb")
                dae = self.converted(first, f"{kind}.dae")
                text = dae.read_text()
                self.assertNotIn("profile_RSL", text)
                # 1000 / pi times (1, 0.7353569831, 0.5370987): 1.055 c ^ (1 / 2.4) - 0.055.
                for got, want in zip(self.color(text, kind + r"[^>]*"), (318.309886, 234.071397, 170.963824)):
                    self.assertAlmostEqual(got, want, 3)
                light = glb_json(self.converted(dae, f"{kind}2.glb"))["extensions"]["KHR_lights_punctual"]["lights"][0]
                self.assertEqual(light["type"], kind)
                self.assertAlmostEqual(light["intensity"], 1000, 6)
                for got, want in zip(light["color"], (1, 0.5, 0.25)):
                    self.assertAlmostEqual(got, want, 9)
                if kind == "spot":
                    self.assertAlmostEqual(light["spot"]["outerConeAngle"], 0.4, 9)

    def test_colors_of_materials_are_encoded_there_and_decoded_back(self):
        factor = {"metallicFactor": 0, "baseColorFactor": [0.5, 0.25, 1, 1]}
        g = Gltf(pbrMetallicRoughness=factor, emissiveFactor=[0.2, 0, 0])
        dae = self.converted(self.save("m", g), "m.dae")
        diffuse = self.color(dae.read_text(), "diffuse")
        for got, want in zip(diffuse, (0.7353569831, 0.5370987, 1)):
            self.assertAlmostEqual(got, want, 6)
        back = glb_json(self.converted(dae, "m.glb"))["materials"][0]
        for got, want in zip(back["pbrMetallicRoughness"]["baseColorFactor"], (0.5, 0.25, 1, 1)):
            self.assertAlmostEqual(got, want, 9)
        self.assertAlmostEqual(back["emissiveFactor"][0], 0.2, 9)

    def test_unlit_colors_look_the_same(self):
        g = Gltf(pbrMetallicRoughness={"baseColorFactor": [0.5, 0.25, 0.02, 1]}, extensions=UNLIT)
        scene = self.save("unlit", g)
        dae = self.converted(scene, "unlit.dae")
        self.assertNotIn("profile_RSL", dae.read_text())
        self.assertLess(self.difference(self.picture(scene), self.picture(dae)), SAME)

    def test_vertex_colors_without_a_material_stay(self):
        text = re.sub(r"<bind_material>.*?</bind_material>", "", mesh_scene(), flags=re.S).replace(
            "<vertices", '<source id="c"><float_array id="ca" count="9">0.5 0.2 0.1 0.2 0.5 0.1 0.1 0.2 0.5'
            '</float_array><technique_common><accessor source="#ca" count="3" stride="3"><param name="R" type="float"/>'
            '<param name="G" type="float"/><param name="B" type="float"/></accessor></technique_common></source><vertices'
        ).replace("<p>", '<input semantic="COLOR" source="#c" offset="0"/><p>')
        scene = self.write("colors.dae", text)
        glb = self.converted(scene, "colors.glb")
        self.assertLess(self.difference(self.picture(scene), self.picture(glb)), SAME)
        self.assertGreater(self.difference(self.picture(scene), self.picture(self.write("bare.dae", re.sub(
            '<input semantic="COLOR"[^>]*>', "", text)))), 1)

    def test_only_materials_in_rsl_have_profile_rsl_and_the_rest_passes_the_official_schema(self):
        code = "surface s() { Ci = 1; Oi = 1; }"
        plain = {"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5]}}
        dae = self.converted(self.save("plain", Gltf(**plain)), "plain.dae")
        rsl = self.converted(self.save("rsl", Gltf(extras={"kinora_rsl": {"surface": {"code": code}}})), "rsl.dae")
        self.assertNotIn("profile_RSL", dae.read_text())
        self.assertIn("profile_RSL", rsl.read_text())
        official(self, dae, self.converted(self.save("spot", self.light(
            type="spot", intensity=5, range=3, spot={"innerConeAngle": 0.1, "outerConeAngle": 0.5})), "spot.dae"))

    def test_modes_of_transparency_are_those_of_1_4_1(self):
        for mode, color in (("A_ZERO", "1 1 1 0.4"), ("RGB_ONE", "0.3 0.6 0.9 1")):
            with self.subTest(mode):
                scene = self.write(f"{mode}.dae", mesh_scene().replace(
                    "</diffuse>", f'</diffuse><transparent opaque="{mode}"><color>{color}</color></transparent>'
                    "<transparency><float>0.5</float></transparency>"))
                dae = self.converted(self.converted(scene, f"{mode}.glb"), f"{mode}-2.dae")
                self.assertNotIn(mode, dae.read_text())
                self.assertLess(self.difference(self.picture(scene), self.picture(dae)), SAME)
                official(self, dae)


def official(test, *documents):
    """They pass the official schema of 1.4.1."""
    schema = schema_agreement_test.OFFICIAL["V14"]
    if not shutil.which("xmllint") or not schema.exists():
        test.skipTest("no xmllint, or no official schema")
    for name, text in (("xml.xsd", schema_agreement_test.XML_XSD), ("math.xsd", schema_agreement_test.MATH_XSD),
                       ("catalog.xml", schema_agreement_test.CATALOG)):
        (test.folder / name).write_text(text)
    done = subprocess.run(["xmllint", "--nonet", "--noout", "--schema", schema, *documents], capture_output=True,
                          text=True, env={**os.environ, "XML_CATALOG_FILES": str(test.folder / "catalog.xml")})
    test.assertEqual(done.returncode, 0, done.stderr[-2000:])


class Motion(GltfConvert):
    def test_each_animation_stays_a_clip(self):
        g = Gltf()
        time = g.floats("SCALAR", [0, 1], bounds=True)
        moves = {"walk": ([0, 0, 0, 1, 0, 0], "translation"), "jump": ([0, 0, 0, 0, 1, 0], "translation"),
                 "grow": ([1, 1, 1, .5, .5, .5], "scale")}
        g.tree["animations"] = [
            {"name": name, "channels": [{"sampler": 0, "target": {"node": 0, "path": path}}],
             "samplers": [{"input": time, "output": g.floats("VEC3", numbers)}]}
            for name, (numbers, path) in moves.items()]
        scene = self.save("three", g)
        out = self.converted(scene, "three.glb", "--strict")
        self.assertEqual([a["name"] for a in glb_json(out)["animations"]], list(moves))
        pictures = []
        for words in [("--time", "1"), *(("--clip", name, "--time", "1") for name in moves)]:
            pictures.append(self.picture(scene, *words))
            self.assertLess(self.difference(pictures[-1], self.picture(out, *words)), SAME)
        for k in range(1, 4):
            self.assertGreater(self.difference(pictures[k], pictures[k % 3 + 1]), 1)
        self.valid(out)

    def test_a_clip_that_holds_a_node_elsewhere_does(self):
        g = Gltf()
        time = g.floats("SCALAR", [0, 1], bounds=True)
        g.tree["animations"] = [
            {"name": name, "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
             "samplers": [{"input": time, "output": g.floats("VEC3", numbers)}]}
            for name, numbers in (("go", [0, 0, 0, 1, 0, 0]), ("stay", [-.5, .5, 0] * 2))]
        scene = self.save("stay", g)
        self.stays(scene, "--clip", "stay", "--time", "1")
        self.stays(scene, "--clip", "go", "--time", "0")

    def test_turns_about_one_axis_are_angles_in_collada(self):
        def quaternion(axis, degrees, sign=1):
            half = math.radians(degrees / 2)
            return [sign * axis[k] * math.sin(half) for k in range(3)] + [sign * math.cos(half)]

        def turning(name, rotations, more=()):
            g = Gltf(pbrMetallicRoughness={"baseColorFactor": [0.5, 0.25, 0.02, 1]}, extensions=UNLIT)
            time = g.floats("SCALAR", [0, 1, 2], bounds=True)
            rows = [("rotation", "VEC4", sum(rotations, [])), *more]
            g.tree["animations"] = [{
                "channels": [{"sampler": k, "target": {"node": 0, "path": row[0]}} for k, row in enumerate(rows)],
                "samplers": [{"input": time, "output": g.floats(*row[1:])} for row in rows]}]
            return self.converted(self.save(name, g), f"{name}.glb")
        x, z = (1, 0, 0), (0, 0, 1)
        moving = ("translation", "VEC3", [0, 0, 0, .5, .25, 0, -.5, .25, 0])
        # From 100 degrees on to 260, though the second number has the other sign; a half turn is positive.
        rows = [("spin", [quaternion(z, 0), quaternion(z, 100), quaternion(z, 260, -1)], [0, 100, 260]),
                ("back", [quaternion(z, 0), quaternion(z, 300), quaternion(z, 240)], [0, -60, -120]),
                ("half", [quaternion(z, 10), quaternion(z, 190), quaternion(z, 190)], [10, 190, 190]),
                ("tumble", [quaternion(z, 0), quaternion(z, 80), quaternion(x, 80)], None)]
        for name, rotations, angles in rows:
            with self.subTest(name):
                glb = turning(name, rotations, [moving])
                dae = self.converted(glb, f"{name}.dae", "--strict")
                text = dae.read_text()
                self.assertEqual(len(re.findall('semantic="INPUT"', text)), 2)
                self.assertEqual(len(set(re.findall('semantic="INPUT" source="([^"]*)"', text))), 1)
                self.assertIn('/translate0"', text)
                self.assertEqual("<matrix" in text, angles is None)
                if angles:
                    self.assertIn('/rotation1.ANGLE"', text)
                    arrays = [list(map(float, a.split())) for a in re.findall('<float_array[^>]*count="3">([^<]*)<', text)]
                    self.assertTrue(any(all(abs(a - b) < 1e-4 for a, b in zip(angles, have)) for have in arrays), arrays)
                official(self, dae)
                for time in ("0", "0.5", "1", "1.7", "2"):
                    self.assertLess(self.difference(self.picture(glb, "--time", time), self.picture(dae, "--time", time)), SAME)
        still = Gltf()
        still.tree["nodes"][0].update(rotation=quaternion(z, 20), scale=[2, 1, 1])
        text = self.converted(self.save("still", still), "still.dae").read_text()
        self.assertIn("<rotate>0 0 1 20</rotate>", text)
        self.assertIn("<scale>2 1 1</scale>", text)

    def test_the_node_of_axes_and_unused_materials_and_inputs_are_not_written(self):
        scene = self.write("a.dae", mesh_scene(asset='<asset><unit meter="0.01"/><up_axis>Z_UP</up_axis></asset>'))
        glb = self.converted(scene, "a.glb")
        dae = self.converted(glb, "b.dae")
        text = dae.read_text()
        self.assertEqual(len(re.findall("<node ", text)), len(re.findall("<node ", scene.read_text())))
        self.assertEqual(len(re.findall("<material ", text)), 1)
        self.assertNotIn("bind_vertex_input", text)
        self.assertIn('meter="0.01"', text)
        self.assertIn("Z_UP", text)
        self.assertLess(self.difference(self.picture(scene), self.picture(dae)), SAME)
        # And again: no node around a node.
        names = [n["name"] for n in glb_json(self.converted(glb, "c.glb"))["nodes"]]
        self.assertEqual(names.count("axes and unit"), 1)
        self.assertEqual(names, [n["name"] for n in glb_json(glb)["nodes"]])

    TURN = """<library_animations><animation id="a">
<source id="i"><float_array id="ia" count="3">0 1 2</float_array><technique_common><accessor source="#ia" count="3">
<param name="TIME" type="float"/></accessor></technique_common></source><source id="o"><float_array id="oa" count="3">0 90 180</float_array>
<technique_common><accessor source="#oa" count="3"><param name="ANGLE" type="float"/></accessor></technique_common></source>
<sampler id="s"><input semantic="INPUT" source="#i"/><input semantic="OUTPUT" source="#o"/></sampler>
<channel source="#s" target="n/r.ANGLE"/></animation></library_animations>"""

    def test_clips_of_parts_of_the_animation_are_animations_beside_the_whole(self):
        rise = (self.TURN.replace('id="', 'id="y').replace('"#', '"#y').replace("ANGLE", "Y").replace("r.Y", "t.Y")
                .replace("0 90 180", "0 0.5 1").replace('<library_animations>', "").replace("</library_animations>", ""))
        clip = ('<library_animation_clips><animation_clip id="turn" name="turn" start="0" end="2">'
                '<instance_animation url="#a"/></animation_clip>'
                '<animation_clip id="rise" name="rise" start="0" end="1">'
                '<instance_animation url="#ya"/></animation_clip></library_animation_clips>')
        scene = self.write("parts.dae", mesh_scene(
            self.TURN.replace("</library_animations>", rise + "</library_animations>") + clip))
        out = self.converted(scene, "parts.glb", "--strict")
        self.assertEqual([a["name"] for a in glb_json(out)["animations"]], ["all", "turn", "rise"])
        for words in ((), ("--clip", "turn"), ("--clip", "rise")):
            for time in ("0", "1", "2"):
                self.assertLess(self.difference(self.picture(scene, "--time", time, *words),
                                                self.picture(out, "--time", time, *words)), SAME)
        self.assertGreater(self.difference(self.picture(scene, "--time", "0"), self.picture(scene, "--time", "2")), 1)

    def test_shear_between_keys_is_there(self):
        # At 0, 90 and 180 degrees a turn below a stretch is none of it, between them it shears.
        text = mesh_scene(self.TURN).replace('<translate sid="t">0 0 0</translate><rotate sid="r">0 1 0 20</rotate>',
                                             '<scale>3 1 1</scale><rotate sid="r">0 0 1 0</rotate>')
        scene = self.write("shear.dae", text)
        out = self.converted(scene, "shear.glb", "--strict")
        for time in ("0", "0.5", "1.4", "2"):
            with self.subTest(time):
                self.assertLess(self.difference(self.picture(scene, "--time", time),
                                                self.picture(out, "--time", time)), SAME)


class Skins(GltfConvert):
    def skinned(self, joints, weights):
        """The triangle bound to nodes a and b, both roots of a metre scene with y up."""
        controller = f"""<library_controllers><controller id="sk"><skin source="#tri">
<source id="j"><Name_array id="ja" count="2">a b</Name_array><technique_common><accessor source="#ja" count="2">
<param name="JOINT" type="name"/></accessor></technique_common></source>
<source id="b"><float_array id="ba" count="32">{"1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 " * 2}</float_array><technique_common>
<accessor source="#ba" count="2" stride="16"><param name="TRANSFORM" type="float4x4"/></accessor></technique_common></source>
<source id="w"><float_array id="wa" count="1">1</float_array><technique_common><accessor source="#wa" count="1">
<param name="WEIGHT" type="float"/></accessor></technique_common></source>
<joints><input semantic="JOINT" source="#j"/><input semantic="INV_BIND_MATRIX" source="#b"/></joints>
<vertex_weights count="3"><input semantic="JOINT" source="#j" offset="0"/><input semantic="WEIGHT" source="#w" offset="1"/>
<vcount>1 1 1</vcount><v>{" ".join(f"{j} 0" for j in joints)}</v></vertex_weights></skin></controller></library_controllers>"""
        text = mesh_scene(controller).replace("<instance_geometry", '<instance_controller url="#sk">'
                                              '<skeleton>#a</skeleton><skeleton>#b</skeleton><!--').replace(
            '"#tri"><bind_material>', '"--><bind_material>').replace("</instance_geometry>", "</instance_controller>")
        text = text.replace("0 1 0 20", "0 1 0 0").replace(
            '<node id="n">', """<node id="a" sid="a" type="JOINT"><translate>0.2 0 0</translate></node>
<node id="b" sid="b" type="JOINT"><translate>0 0.4 0</translate></node><node id="n">""")
        return text

    def test_joints_below_several_roots_have_a_common_one(self):
        for name, joints in (("apart", (0, 1, 1)), ("none", (-1, 0, 0))):
            with self.subTest(name):
                scene = self.write(f"{name}.dae", self.skinned(joints, 1))
                before, out = self.stays(scene, times=3)
                self.assertGreater(len(set(before[2])), 1)
                json_ = glb_json(out)
                parents = {c: n for n, node in enumerate(json_["nodes"]) for c in node.get("children", [])}

                def top(node):
                    return top(parents[node]) if node in parents else node
                for skin in json_["skins"]:
                    self.assertEqual(len({top(j) for j in skin["joints"]}), 1)
                # What is put over them is not put there once more.
                self.assertEqual(sum(n.get("name") == "root of the joints" for n in json_["nodes"]), 1)


class Texts(GltfConvert):
    def test_a_document_that_no_reader_takes_is_not_written(self):
        g = Gltf()
        for _ in range(300):
            g.tree["nodes"].append({"children": [len(g.tree["nodes"]) + 1]})
        g.tree["nodes"].append({})
        g.tree["scenes"][0]["nodes"].append(2)
        out = self.folder / "deep.dae"
        self.expect(convert(self.save("deep", g), out), 6, "XML_DEPTH", "cannot write")
        self.assertFalse(out.exists())

    def test_characters_that_xml_forbids_are_named_or_escaped(self):
        g = Gltf()
        g.tree["nodes"][0].update(name="a\u0001b", extras={"kinora_attributes": {"note": "bell\u0007!"}})
        out = self.folder / "bell.dae"
        self.expect(convert(self.save("bell", g), out, "--strict"), 1, "CONVERT_LOST", "control character")
        self.assertIn("bell !", out.read_text())
        self.image("a\vb.png", [(255, 0, 0)])
        g = Materials.textured(self)
        g.tree["images"] = [{"uri": "a%0Bb.png"}]
        out = self.converted(self.save("tab", g), "tab.dae")
        self.assertIn("<init_from>a%0Bb.png</init_from>", out.read_text())
        self.assertGreater(self.brightest(self.picture(out), 0), 200)

    def test_numbers_that_are_none_are_named_as_xml_schema_does(self):
        nan, inf = float("nan"), float("inf")
        g = Gltf()
        g.attributes["POSITION"] = g.floats("VEC3", [-1, 0, 0, 1, 0, 0, nan, inf, -inf])
        text = self.converted(self.save("nan", g), "nan.dae").read_text()
        self.assertIn(">-1 0 0 1 0 0 NaN INF -INF<", text)

    def shader(self):
        path = self.folder / "latin.sl"
        path.write_bytes('surface s() { printf("café\n"); /* \f */ Ci = 1; Oi = 1; }'.replace("\n", "\\n").encode("latin-1"))
        return path

    def test_shaders_in_latin_1_are_recoded_and_nothing_else(self):
        scene = self.write("green.dae", mesh_scene().replace('name="Red"', 'name="Grün"'))
        text = self.converted(scene, "g.dae", "--shader", f"red={self.shader()}").read_text(encoding="utf-8")
        self.assertIn("Grün", text)
        self.assertIn('"café', text)
        out = self.converted(scene, "g.glb", "--shader", f"red={self.shader()}")
        self.assertIn("café", glb_json(out)["materials"][0]["extras"]["kinora_rsl"]["surface"]["code"])
        self.assertIn('"café', self.converted(out, "h.dae").read_text(encoding="utf-8"))

    def test_data_uris_may_hold_more_than_their_buffer(self):
        g = Gltf()
        before = self.picture(self.save("exact", g))
        for k in (1, 2, 3, 4, 100):
            for slash in ("/", "\\/", "\\u002f"):
                with self.subTest((k, slash)):
                    text = g.text(b"\xff" * k)
                    at = text.index("base64,") + 7
                    text = text[:at] + text[at:].replace("/", slash)
                    self.assertEqual(self.picture(self.save("more", text)), before)
        cut = g.text().replace('"byteLength": ' + str(len(g.bytes)) + ', "uri"', '"byteLength": 10000, "uri"')
        self.assertNotEqual(cut, g.text())
        result = convert(self.save("less", cut), self.folder / "less.glb")
        self.expect(result, 3, "GLTF_INVALID")
        self.assertLess(max(len(line) for line in result.err.splitlines() if "GLTF_INVALID" in line), 250)


if __name__ == "__main__":
    programs.main()
