"""tests/programs/convert/same_picture_test.py: what the picture shows, every writer writes: hidden nodes, normals,
texture coordinates, clips, places far away; and what no validator takes is not written."""
import json
import struct
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import programs
from convert_gltf_test import Gltf, GltfConvert
from convert_test import LIKE, convert, glb_json
from programs import render, run

CUBE = "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1"
FACES = "0 3 2 1 4 5 6 7 0 1 5 4 1 2 6 5 2 3 7 6 3 0 4 7"
HIDDEN = '<extra><technique profile="FCOLLADA"><visibility>0</visibility></technique></extra>'


def source(name, values, params, kind="float_array", stride=None):
    """A <source>; `values` is text."""
    count, width = len(values.split()), stride or len(params)
    return (f'<source id="{name}"><{kind} id="{name}-a" count="{count}">{values}</{kind}><technique_common>'
            f'<accessor source="#{name}-a" count="{count // width}" stride="{width}">'
            + "".join(f'<param name="{p}" type="{"name" if kind == "Name_array" else "float"}"/>' for p in params)
            + "</accessor></technique_common></source>")


def effect(name, color):
    return (f'<effect id="{name}-fx"><profile_COMMON><technique sid="t"><lambert><diffuse><color>{color} 1</color>'
            "</diffuse></lambert></technique></profile_COMMON></effect>")


def animation(name, target, times, values, params=("X", "Y", "Z")):
    return (f'<animation id="{name}">' + source(name + "-i", times, ["TIME"]) + source(name + "-o", values, params)
            + source(name + "-n", " ".join(["LINEAR"] * len(times.split())), ["INTERPOLATION"], "Name_array")
            + f'<sampler id="{name}-s"><input semantic="INPUT" source="#{name}-i"/><input semantic="OUTPUT" '
            f'source="#{name}-o"/><input semantic="INTERPOLATION" source="#{name}-n"/></sampler>'
            f'<channel source="#{name}-s" target="{target}"/></animation>')


def document(nodes, libraries="", positions=CUBE, inputs="", sources="", stride=1, faces=FACES):
    """Nodes with cubes "#cube" that wear m (orange) or b (blue)."""
    indices = " ".join(" ".join([i] * stride) for i in faces.split())
    materials = "".join(f'<material id="{m}" name="{m}"><instance_effect url="#{m}-fx"/></material>' for m in "mb")
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><created>2026-01-01T00:00:00Z</created>
<modified>2026-01-01T00:00:00Z</modified><unit meter="1"/><up_axis>Y_UP</up_axis></asset>{libraries}
<library_effects>{effect("m", "0.9 0.5 0.1")}{effect("b", "0.1 0.2 0.9")}</library_effects>
<library_materials>{materials}</library_materials>
<library_geometries><geometry id="cube"><mesh>{source("p", positions, "XYZ")}{sources}<vertices id="v">
<input semantic="POSITION" source="#p"/></vertices><polylist material="m" count="6"><input semantic="VERTEX" source="#v" offset="0"/>
{inputs}<vcount>4 4 4 4 4 4</vcount><p>{indices}</p></polylist></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s">{nodes}</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>
"""


def cube(material="m", binds=""):
    return (f'<instance_geometry url="#cube"><bind_material><technique_common><instance_material symbol="m" '
            f'target="#{material}">{binds}</instance_material></technique_common></bind_material></instance_geometry>')


def numbers_of(glb, accessor):
    """The floats of an accessor, element by element."""
    tree, data = glb_json(glb), Path(glb).read_bytes()
    binary = 20 + struct.unpack_from("<I", data, 12)[0] + 8
    a = tree["accessors"][accessor]
    view = tree["bufferViews"][a["bufferView"]]
    width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[a["type"]]
    numbers = struct.unpack_from(f"<{a['count'] * width}f", data,
                                 binary + view.get("byteOffset", 0) + a.get("byteOffset", 0))
    return [numbers[i:i + width] for i in range(0, len(numbers), width)]


class SamePicture(GltfConvert):
    def both_ways(self, scene, *words):
        """.dae -> .glb -> .dae, all of one picture; returns the two written files."""
        before = self.picture(scene, *words)
        glb = self.converted(scene, scene.stem + "-1.glb")
        dae = self.converted(glb, scene.stem + "-2.dae")
        for file in (glb, dae):
            self.assertLess(self.difference(before, self.picture(file, *words)), LIKE, file.name)
        self.valid(glb)
        return glb, dae


class Visibility(SamePicture):
    ROWS = {
        "a node": f'<node id="a">{cube()}{HIDDEN}</node><node id="c"><translate>2 0 0</translate>{cube("b")}</node>',
        "a parent": f'<node id="o"><node id="a">{cube()}</node>{HIDDEN}</node><node id="c">{cube("b")}</node>',
        "a child": f'<node id="o"><translate>2 0 0</translate>{cube("b")}'
                                        f'<node id="a"><translate>-3 0 0</translate>{cube()}{HIDDEN}</node></node>',
        "a light": f'<node id="c">{cube("b")}</node><node id="l"><rotate>1 0 0 -90</rotate>'
                   f'<instance_light url="#sun"/>{HIDDEN}</node>',
    }
    SUN = ('<library_lights><light id="sun"><technique_common><directional><color>1 1 1</color></directional>'
           "</technique_common></light></library_lights>")

    def test_what_is_hidden_stays_hidden_in_all_formats(self):
        for k, (name, nodes) in enumerate(self.ROWS.items()):
            with self.subTest(name):
                scene = self.write(f"h{k}.dae", document(nodes, self.SUN if "light" in name else ""))
                glb, dae = self.both_ways(scene)
                tree = glb_json(glb)
                self.assertIn("KHR_node_visibility", tree["extensionsUsed"])
                self.assertNotIn("KHR_node_visibility", tree.get("extensionsRequired", []))
                self.assertIn("<visibility>0</visibility>", dae.read_text())
                shown = self.write(f"s{k}.dae", scene.read_text().replace(HIDDEN, ""))
                if name != "a light":
                    self.assertGreater(self.difference(self.picture(scene), self.picture(shown)), LIKE)

    def test_a_hidden_node_of_gltf_is_not_seen(self):
        gltf = Gltf()
        gltf.tree["nodes"][0]["extensions"] = {"KHR_node_visibility": {"visible": False}}
        gltf.tree["nodes"].append({"mesh": 0, "scale": [0.2, 0.2, 0.2]})
        gltf.tree["scenes"][0]["nodes"].append(2)
        gltf.tree["extensionsUsed"] = ["KHR_node_visibility"]
        hidden = self.save("hidden", gltf)
        self.expect(render(hidden, "-v", "--list", "cameras"), 0, "GLTF_HIDDEN")
        del gltf.tree["nodes"][0]["mesh"]
        self.assertEqual(self.picture(hidden), self.picture(self.save("gone", gltf)))
        dae = self.converted(hidden, "hidden.dae")
        self.assertLess(self.difference(self.picture(hidden), self.picture(dae)), LIKE)

    def test_a_file_that_hides_all_shows_all_in_both_formats(self):
        gltf = Gltf()
        whole = self.picture(self.save("whole", gltf))
        gltf.tree["nodes"][0]["extensions"] = {"KHR_node_visibility": {"visible": False}}
        gltf.tree["extensionsUsed"] = ["KHR_node_visibility"]
        self.assertEqual(whole, self.picture(self.save("all", gltf)))

    def test_values_that_are_no_false_hide_nothing(self):
        for k, value in enumerate([True, 0, "false", None, {}]):
            gltf = Gltf()
            gltf.tree["nodes"][0]["extensions"] = {"KHR_node_visibility": {"visible": value}}
            gltf.tree["extensionsUsed"] = ["KHR_node_visibility"]
            result = render(self.save(f"v{k}", gltf), "-v", "--list", "cameras")
            self.assertNotIn("GLTF_HIDDEN", result.err)


class Normals(SamePicture):
    def scene(self, name, normals):
        return self.write(name, document(f'<node id="a">{cube()}</node>', sources=source("n", normals, "XYZ"),
                                         inputs='<input semantic="NORMAL" source="#n" offset="0"/>'))

    def test_a_normal_that_is_none_is_that_of_its_face_in_all_formats(self):
        rows = {"short.dae": "0 0 1 0 1 0", "zero.dae": "0 0 0 " * 8, "empty.dae": "",
                "some.dae": "0 0 0 0 0 0 1 0 0 0 1 0 0 0 0 0 0 1 0 0 1 0 0 0"}
        for name, normals in rows.items():
            with self.subTest(name):
                self.both_ways(self.scene(name, normals))

    def test_faces_without_normals_are_flat(self):
        """All normals zero: each vertex has the normal of a face of the cube, which by hand is one of six axes."""
        glb = self.converted(self.scene("zero.dae", "0 0 0 " * 8), "zero.glb")
        attributes = glb_json(glb)["meshes"][0]["primitives"][0]["attributes"]
        axes = {tuple(sign * float(a == b) + 0.0 for b in range(3)) for a in range(3) for sign in (-1, 1)}
        if "NORMAL" in attributes:
            normals = {tuple(round(x, 5) + 0.0 for x in n) for n in numbers_of(glb, attributes["NORMAL"])}
            self.assertEqual(normals, axes)
        self.valid(glb)


class TextureCoordinates(SamePicture):
    def scene(self, name, sets, binds):
        self.image("t.png", [(255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)])
        textured = ('<library_images><image id="im"><init_from>t.png</init_from></image></library_images>')
        uv = ("0 0 1 0 1 1 0 1 0 0 1 0 1 1 0 1", "0 0 .4 0 .4 .4 0 .4 0 0 .4 0 .4 .4 0 .4")
        inputs = "".join(f'<input semantic="TEXCOORD" source="#uv{k}" offset="0"{s}/>' for k, s in enumerate(sets))
        text = document(f'<node id="a">{cube("m", binds)}</node>', textured, inputs=inputs,
                        sources="".join(source(f"uv{k}", values, "ST") for k, values in enumerate(uv)))
        params = ('<newparam sid="sf"><surface type="2D"><init_from>im</init_from></surface></newparam>'
                  '<newparam sid="sm"><sampler2D><source>sf</source></sampler2D></newparam>')
        text = text.replace("<profile_COMMON>", "<profile_COMMON>" + params, 1)
        text = text.replace("<color>0.9 0.5 0.1 1</color>", '<texture texture="sm" texcoord="UV"/>', 1)
        return self.write(name, text)

    def test_of_two_inputs_with_one_set_all_formats_show_the_first(self):
        bind = '<bind_vertex_input semantic="UV" input_semantic="TEXCOORD" input_set="{}"/>'
        one = self.picture(self.scene("one.dae", [' set="0"'], bind.format(0)))
        rows = {"twice.dae": ([' set="0"', ' set="0"'], bind.format(0)), "bare.dae": (["", ""], ""),
                "bound.dae": (["", ""], bind.format(0)), "later.dae": ([' set="3"', ' set="3"'], bind.format(3))}
        for name, (sets, binds) in rows.items():
            with self.subTest(name):
                scene = self.scene(name, sets, binds)
                self.assertEqual(one, self.picture(scene))
                self.both_ways(scene)

    def test_sets_of_their_own_stay_apart(self):
        bind = '<bind_vertex_input semantic="UV" input_semantic="TEXCOORD" input_set="{}"/>'
        first = self.scene("first.dae", [' set="0"', ' set="1"'], bind.format(0))
        second = self.scene("second.dae", [' set="0"', ' set="1"'], bind.format(1))
        self.assertGreater(self.difference(self.picture(first), self.picture(second)), LIKE)
        self.both_ways(second)


class Samplers(SamePicture):
    def test_filters_and_wraps_of_textures_stay_in_dae(self):
        """OpenGL's numbers of glTF 2.0 (sampler.minFilter) and COLLADA 1.4.1's words for them."""
        words = {9728: "NEAREST", 9729: "LINEAR", 9984: "NEAREST_MIPMAP_NEAREST", 9985: "LINEAR_MIPMAP_NEAREST",
                 9986: "NEAREST_MIPMAP_LINEAR", 9987: "LINEAR_MIPMAP_LINEAR", None: "LINEAR_MIPMAP_LINEAR"}
        self.image("fine.png", [((x * 37) % 256, (x * 91) % 256, x % 256) for x in range(64 * 64)])
        for number, word in words.items():
            with self.subTest(word):
                gltf = Gltf(pbrMetallicRoughness={"metallicFactor": 0, "baseColorTexture": {"index": 0}})
                gltf.attributes["TEXCOORD_0"] = gltf.floats("VEC2", [0, 0, 3, 0, 1, 3])
                gltf.tree["images"] = [{"uri": "fine.png"}]
                gltf.tree["samplers"] = [{"magFilter": 9728, "wrapS": 33648, **({"minFilter": number} if number else {})}]
                gltf.tree["textures"] = [{"source": 0, "sampler": 0}]
                scene = self.save(f"s{number}", gltf)
                dae = self.converted(scene, f"s{number}.dae")
                for text in (f"<minfilter>{word}</minfilter>", "<magfilter>NEAREST</magfilter>", "<wrap_s>MIRROR</wrap_s>"):
                    self.assertIn(text, dae.read_text())
                self.assertLess(self.difference(self.picture(scene), self.picture(dae)), LIKE)


class Clips(SamePicture):
    IDLE = animation("ia", "a/t", "0 1", "0 0 0 0 1 0")
    RUN = animation("ra", "a/t", "0 1", "0 0 0 3 0 0") + animation("rb", "a/r.ANGLE", "0 1", "0 90", ["ANGLE"])

    def scene(self, name, clips, animations):
        nodes = (f'<node id="a"><translate sid="t">0 0 0</translate><rotate sid="r">0 0 1 0</rotate>{cube()}</node>'
                 f'<node id="c"><translate>3 2 0</translate>{cube("b")}</node>')
        return self.write(name, document(nodes, f"<library_animations>{animations}</library_animations>"
                                         f"<library_animation_clips>{clips}</library_animation_clips>"))

    def clip(self, name, *animations, shown="", start=0, end=1):
        return (f'<animation_clip id="{name}"{shown and f" name={chr(34)}{shown}{chr(34)}"} start="{start}" end="{end}">'
                + "".join(f'<instance_animation url="#{a}"/>' for a in animations) + "</animation_clip>")

    def listed(self, scene):
        return {line[5:line.rindex(" to ")].rsplit(" ", 1)[0]
                for line in render(scene, "--list", "clips").out.splitlines() if line.startswith("clip ")}

    def same_clips(self, a, b, clips):
        self.assertEqual(self.listed(a), set(clips))
        self.assertEqual(self.listed(b), set(clips))
        for words in ([], *(["--clip", c] for c in clips)):
            for time in ("0", "0.5", "1"):
                self.assertLess(self.difference(self.picture(a, *words, "--time", time),
                                                self.picture(b, *words, "--time", time)), LIKE, (words, time))

    def test_clips_with_animations_of_their_own_are_animations_of_gltf_and_back(self):
        scene = self.scene("c.dae", self.clip("idle", "ia") + self.clip("run", "ra", "rb"), self.IDLE + self.RUN)
        glb = self.converted(scene, "c.glb")
        self.assertEqual({a["name"] for a in glb_json(glb)["animations"]}, {"idle", "run"})
        self.same_clips(scene, glb, ["idle", "run"])
        dae = self.converted(glb, "back.dae")
        self.same_clips(scene, dae, ["idle", "run"])
        self.assertEqual(dae.read_text().count("<animation_clip"), 2)
        again = self.converted(dae, "again.glb")
        self.same_clips(scene, again, ["idle", "run"])
        self.valid(glb, again)

    def test_clips_that_no_order_plays_together_leave_the_whole_as_it_was(self):
        """Both drive t, and each something else: what plays without a clip is neither's."""
        turn = animation("ib", "a/r.ANGLE", "0 1", "0 45", ["ANGLE"])
        lift = animation("rc", "c/u", "0 1", "3 2 0 3 3 0")
        text = self.scene("w.dae", self.clip("idle", "ia", "ib") + self.clip("run", "ra", "rc"),
                          self.RUN.replace('id="rb"', 'id="rb"') + self.IDLE + turn + lift).read_text()
        scene = self.write("w.dae", text.replace('<node id="c"><translate>', '<node id="c"><translate sid="u">'))
        glb = self.converted(scene, "w.glb")
        self.same_clips(scene, glb, ["idle", "run"])
        self.same_clips(scene, self.converted(glb, "w2.dae"), ["idle", "run"])

    def test_names_are_taken_and_ids_too(self):
        clips = (self.clip("c1", "ia", shown="walk") + self.clip("c2", "ra", "rb", shown="run fast")
                 + self.clip("c3", "ia"))
        scene = self.scene("n.dae", clips, self.IDLE + self.RUN)
        self.assertEqual(self.listed(scene), {"walk", "run fast", "c3"})
        for name, other in (("walk", "c1"), ("run fast", "c2"), ("c3", "c3")):
            self.assertEqual(self.picture(scene, "--clip", name, "--time", "0.5"),
                             self.picture(scene, "--clip", other, "--time", "0.5"))
        self.assertEqual(render(scene, "--clip", "walks", "-o", self.folder / "x.png").code, 2)
        self.expect(run("kinora-validate", scene, "--info"), 0, "run fast")
        glb = self.converted(scene, "n.glb")
        self.assertEqual({a["name"] for a in glb_json(glb)["animations"]} - {"all"}, {"walk", "run fast", "c3"})
        dae = self.converted(glb, "n2.dae")
        self.same_clips(scene, dae, ["walk", "run fast", "c3"])

    def test_a_clips_range_beyond_its_keys_stays(self):
        scene = self.scene("r.dae", self.clip("idle", "ia", start=-1, end=3), self.IDLE)
        for file in self.both_ways(scene, "--time", "0.5"):
            self.assertIn("clip idle -1 to 3 s", render(file, "--list", "clips").out)

    def test_two_animations_of_one_name_are_two_clips(self):
        gltf = Gltf(pbrMetallicRoughness={"metallicFactor": 0})
        times = gltf.floats("SCALAR", [0, 1], bounds=True)
        channel = [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]
        gltf.tree["animations"] = [
            {"name": "a", "channels": channel,
             "samplers": [{"input": times, "output": gltf.floats("VEC3", [0, 0, 0, x, 0, 0])}]} for x in (0.3, -0.6)]
        scene = self.save("two", gltf)
        dae = self.converted(scene, "two.dae")
        self.assertEqual(dae.read_text().count("<animation_clip"), 2)
        self.same_clips(scene, dae, sorted(self.listed(scene)))

    def test_what_moves_in_a_later_clip_alone_rests_without_it(self):
        """The second animation meets the first, so that it plays by its clip alone, its scale too."""
        gltf = Gltf(pbrMetallicRoughness={"metallicFactor": 0})
        times = gltf.floats("SCALAR", [0, 2], bounds=True)

        def animation(name, **paths):
            rows = [({"sampler": k, "target": {"node": 0, "path": path}},
                     {"input": times, "output": gltf.floats("VEC4" if path == "rotation" else "VEC3", values)})
                    for k, (path, values) in enumerate(paths.items())]
            return {"name": name, "channels": [r[0] for r in rows], "samplers": [r[1] for r in rows]}
        gltf.tree["animations"] = [
            animation("slide", translation=[0, 0, 0, 0.5, 0, 0]),
            animation("grow", translation=[0, 0, 0, 0, -0.5, 0], scale=[1, 1, 1, 0.2, 0.2, 1],
                      rotation=[0, 0, 0, 1, 0, 0, 0.7071068, 0.7071068])]
        scene = self.save("grow", gltf)
        dae = self.converted(scene, "grow.dae")
        self.same_clips(scene, dae, ["slide", "grow"])


class FarAway(SamePicture):
    def far(self, name, side, at):
        places = " ".join(str(round(float(x) * side + a, 6))
                          for x, a in zip(CUBE.split(), [at[0], at[1], at[2]] * 8))
        return self.write(name, document(f'<node id="a">{cube()}</node>', positions=places))

    def test_georeferenced_vertices_keep_their_shape(self):
        for side, at in ((0.1, (3.5e6, 120, 5.4e6)), (0.3, (3512345.2, 0, -5412345.7)), (2000, (40000001.3, 0, 40000002.7))):
            with self.subTest(side):
                scene = self.far(f"far{side}.dae", side, at)
                glb, dae = self.both_ways(scene)
                tree = glb_json(glb)
                accessor = tree["accessors"][tree["meshes"][0]["primitives"][0]["attributes"]["POSITION"]]
                for low, high in zip(accessor["min"], accessor["max"]):
                    self.assertAlmostEqual((high - low) / side, 1, places=4)
                node = next(n for n in tree["nodes"] if "mesh" in n)
                for k in range(3):
                    self.assertAlmostEqual(node["translation"][k], at[k] + side / 2, delta=1e-4 * side)

    def test_near_vertices_stay_about_their_own_origin(self):
        glb = self.converted(self.far("near.dae", 1, (20, 0, 7)), "near.glb")
        self.assertFalse(any("translation" in n for n in glb_json(glb)["nodes"]))

    def test_translations_keep_their_digits(self):
        gltf = Gltf()
        del gltf.tree["cameras"], gltf.tree["nodes"][1]["camera"]
        rows = ["3512345.25", "3512345.45", "0.1", "-12.000001", "1e-07", "123456789.125"]
        for k, x in enumerate(rows):
            gltf.tree["nodes"].append({"mesh": 0, "translation": [float(x), 0, 0]})
            gltf.tree["scenes"][0]["nodes"].append(2 + k)
        text = self.converted(self.save("digits", gltf), "digits.dae").read_text()
        for x in rows:
            written = [float(t.split()[0]) for t in
                       (part.split("<")[0] for part in text.split("<translate>")[1:])]
            self.assertIn(float(x), written)


class Valid(SamePicture):
    def test_a_vertex_that_no_float_holds_is_not_written(self):
        for k, big in enumerate(("1e39", "-1e300", "3.5e38")):
            places = CUBE.split()
            places[18] = big
            scene = self.write(f"big{k}.dae", document(f'<node id="a">{cube()}</node>', positions=" ".join(places)))
            result = convert(scene, self.folder / f"big{k}.glb")
            self.expect(result, 0, "CONVERT_LOST", "further away than floats reach")
            tree = glb_json(self.folder / f"big{k}.glb")
            accessor = tree["accessors"][tree["meshes"][0]["primitives"][0]["attributes"]["POSITION"]]
            self.assertEqual((accessor["min"], accessor["max"]), ([0, 0, 0], [1, 1, 1]))
            self.valid(self.folder / f"big{k}.glb")

    def test_a_morph_without_targets_has_no_weights(self):
        morph = ('<library_controllers><controller id="mo"><morph source="#cube" method="NORMALIZED"><source id="mo-t">'
                 '<IDREF_array id="mo-ta" count="0"/><technique_common><accessor source="#mo-ta" count="0" stride="1">'
                 '<param name="MORPH_TARGET" type="IDREF"/></accessor></technique_common></source><source id="mo-w">'
                 '<float_array id="mo-wa" count="0"/><technique_common><accessor source="#mo-wa" count="0" stride="1">'
                 '<param name="MORPH_WEIGHT" type="float"/></accessor></technique_common></source><targets>'
                 '<input semantic="MORPH_TARGET" source="#mo-t"/><input semantic="MORPH_WEIGHT" source="#mo-w"/></targets>'
                 "</morph></controller></library_controllers>")
        node = '<node id="a">' + cube().replace("instance_geometry", "instance_controller").replace("#cube", "#mo") + "</node>"
        text = document(node).replace("</library_geometries>", "</library_geometries>" + morph)
        glb = self.converted(self.write("mo.dae", text), "mo.glb")
        self.assertFalse(any("weights" in n for n in glb_json(glb)["nodes"]))
        self.valid(glb)

    def test_metals_are_not_black(self):
        for k, material in enumerate(({}, {"baseColorFactor": [1, 0.77, 0.34, 1], "roughnessFactor": 0.3}, None,
                                      {"metallicFactor": 1, "roughnessFactor": 0}, {"metallicFactor": 0.5})):
            with self.subTest(material=material):
                gltf = Gltf() if material is None else Gltf(pbrMetallicRoughness=material)
                scene = self.save(f"metal{k}", gltf)
                dae = self.folder / f"metal{k}.dae"
                result = self.expect(convert(scene, dae), 0)
                before, after = (self.brightest(self.picture(f), 0) for f in (scene, dae))
                self.assertGreater(after, 0.4 * before)
                self.assertLess(after, 2.5 * before)
                self.assertIn("that it is metal", result.err)


if __name__ == "__main__":
    programs.main()
