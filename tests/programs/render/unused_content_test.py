"""tests/programs/render/unused_content_test.py: what a picture does not need costs nothing in a frame: walker.dae with
unused content added does as much work as without, counted."""
import json
import os
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import SCENES, ProgramTest, main, render
from written_scenes import (CAMERA, EYE, WHITE, animation, animations, controllers, document, geometries, one_joint_skin,
                            place, png, rsl, square)

WALKER = (SCENES / "walker.dae").read_text()
# With its first lamp that is no shader, a scene by Blender gets Blender's grey world: this one has no author.
AUTHORLESS = re.sub("<authoring_tool>.*?</authoring_tool>", "", WALKER)
# What a frame does, and what a scene compiled.
PER_FRAME = ("rays", "shadow_rays", "nested_rays", "shading_points", "light_points", "vertices", "columns", "refits",
             "rebuilds")
PER_SCENE = ("kernels", "code_bytes", "derivative_values", "texture_bytes")


def added(library, inside, text=WALKER):
    """The document with content put at the end of a library, or in a new one before the scenes."""
    end = f"</library_{library}>"
    if end in text:
        return text.replace(end, inside + end, 1)
    return text.replace("<library_visual_scenes>", f"<library_{library}>{inside}{end}<library_visual_scenes>", 1)


def in_scene(nodes, text=WALKER):
    return text.replace("</visual_scene>", nodes + "</visual_scene>", 1)


def floats(id, values, stride, names):
    params = "".join(f'<param name="{n}" type="float"/>' for n in names)
    return (f'<source id="{id}"><float_array id="{id}-a" count="{len(values)}">{" ".join(map(str, values))}</float_array>'
            f'<technique_common><accessor source="#{id}-a" count="{len(values) // stride}" stride="{stride}">{params}'
            "</accessor></technique_common></source>")


def unused_animations(count, keys):
    """Channels on nodes of a library that no scene shows."""
    nodes = "".join(f'<node id="ghost{i}"><translate sid="t">0 0 0</translate></node>' for i in range(count))
    text = "".join(
        f'<animation id="ga{i}">{floats(f"ga{i}-i", [k / 10 for k in range(keys)], 1, ["TIME"])}'
        f'{floats(f"ga{i}-o", list(range(keys)), 1, ["X"])}'
        f'<source id="ga{i}-n"><Name_array id="ga{i}-na" count="{keys}">{"LINEAR " * keys}</Name_array><technique_common>'
        f'<accessor source="#ga{i}-na" count="{keys}" stride="1"><param name="INTERPOLATION" type="name"/></accessor>'
        f'</technique_common></source><sampler id="ga{i}-s"><input semantic="INPUT" source="#ga{i}-i"/>'
        f'<input semantic="OUTPUT" source="#ga{i}-o"/><input semantic="INTERPOLATION" source="#ga{i}-n"/></sampler>'
        f'<channel source="#ga{i}-s" target="ghost{i}/t.X"/></animation>' for i in range(count))
    return added("animations", text, added("nodes", nodes))


def unused_effects(count, lines=100):
    """Effects whose shaders have so many lines each, in materials that nothing wears."""
    body = "".join(f"c += color(noise(P * {k + 1}), noise(s * {k}), {k} * a) * mix(1, a, s);\n" for k in range(lines))
    effects = "".join(
        f'<effect id="ue{i}"><profile_RSL><technique sid="t"><code>surface u{i}(float a = {i};) {{ color c = 0;\n{body}'
        'Ci = c; }</code><pass><shader stage="SURFACE"/></pass></technique></profile_RSL></effect>' for i in range(count))
    materials = "".join(f'<material id="um{i}"><instance_effect url="#ue{i}"/></material>' for i in range(count))
    return added("materials", materials, added("effects", effects))


def write_pictures(folder, count, side=4096):
    """The files of unused_images(): one picture by so many names."""
    first = folder / "unused0.png"
    if not first.exists():
        png.write(first, side, side, [bytes([200, 100, 50] * side)] * side)
    for i in range(1, count):
        if not (folder / f"unused{i}.png").exists():
            os.link(first, folder / f"unused{i}.png")


def unused_images(count):
    """Images of materials that nothing wears."""
    images = "".join(f'<image id="ui{i}"><init_from>unused{i}.png</init_from></image>' for i in range(count))
    effects = "".join(
        f'<effect id="ie{i}"><profile_COMMON><newparam sid="sf"><surface type="2D"><init_from>ui{i}</init_from></surface>'
        '</newparam><newparam sid="sm"><sampler2D><source>sf</source></sampler2D></newparam><technique sid="c"><lambert>'
        '<diffuse><texture texture="sm" texcoord="uv"/></diffuse></lambert></technique></profile_COMMON></effect>'
        for i in range(count))
    materials = "".join(f'<material id="im{i}"><instance_effect url="#ie{i}"/></material>' for i in range(count))
    return added("images", images, added("materials", materials, added("effects", effects)))


def meshes_out_of_view(count, hidden=False):
    """Far off behind the camera, where no ray of the picture goes; or hidden within a column."""
    meshes = "".join(
        f'<geometry id="far{i}"><mesh>' + floats(f"far{i}-p", [-1, -1, 0, 1, -1, 0, 1, 1, i, -1, 1, 0], 3, "XYZ") +
        f'<vertices id="far{i}-v"><input semantic="POSITION" source="#far{i}-p"/></vertices><triangles count="2">'
        f'<input semantic="VERTEX" source="#far{i}-v" offset="0"/><p>0 1 2 0 2 3</p></triangles></mesh></geometry>'
        for i in range(count))
    place = (lambda i: f"<translate>-4.75 1.75 {1 + i / 1000}</translate><scale>.01 .01 1e-6</scale>") if hidden else (
        lambda i: f"<translate>{i % 25} -400 {i // 25}</translate>")
    nodes = "".join(f'<node>{place(i)}<instance_geometry url="#far{i}"/></node>' for i in range(count))
    return added("geometries", meshes, in_scene(nodes))


def static_nodes(count):
    return in_scene("".join(f"<node><translate>{i} 0 0</translate></node>" for i in range(count)))


def black_lights(count):
    lights = "".join(f'<light id="bl{i}"><technique_common><point><color>0 0 0</color></point></technique_common></light>'
                     for i in range(count))
    nodes = "".join(f'<node><translate>0 {i} 0</translate><instance_light url="#bl{i}"/></node>' for i in range(count))
    return added("lights", lights, in_scene(nodes, AUTHORLESS))


def lights_that_miss(count):
    lights = "".join(
        f'<light id="ml{i}"><technique_common><spot><color>1 1 1</color><falloff_angle>10</falloff_angle></spot>'
        "</technique_common></light>" for i in range(count))
    # A spot looks along -z of its node: these stand far off and look away.
    nodes = "".join(f'<node><translate>0 0 {-1000 - i}</translate><instance_light url="#ml{i}"/></node>'
                    for i in range(count))
    return added("lights", lights, in_scene(nodes, AUTHORLESS))


def lamps(count, category):
    """Libraries and nodes of RSL lights of a category."""
    id = category.replace(",", "-")
    code = f'light lamp(string __category = "{category}";) {{ illuminate(point "shader" (0, 0, 0)) Cl = 1; }}'
    effect = (f'<effect id="{id}-fx"><profile_RSL><technique sid="t"><code><![CDATA[{code}]]></code><pass>'
              '<shader stage="LIGHT"/></pass></technique></profile_RSL></effect>')
    lights = "".join(
        f'<light id="{id}{i}"><technique_common><point><color>1 1 1</color></point></technique_common><extra>'
        f'<technique profile="RSL"><instance_effect url="#{id}-fx"/></technique></extra></light>' for i in range(count))
    nodes = "".join(f'<node><translate>0 0 5</translate><instance_light url="#{id}{i}"/></node>' for i in range(count))
    return f"<library_effects>{effect}</library_effects><library_lights>{lights}</library_lights>", nodes


def one_lamp_and(libraries="", nodes=""):
    """A square whose shader asks for lights of the category "key", and one such light."""
    library, node = lamps(1, "key")
    code = 'surface s() { Oi = 1; Ci = 0; illuminance("key", P, N, PI / 2) Ci += Cl * (normalize(L) . normalize(N)); }'
    return document(CAMERA + rsl(code) + geometries(square()) + library + libraries, EYE + place() + node + nodes)


def unused_parameters(count):
    """Of the floor's effect: parameters that its shader does not have, and outputs that nobody asks for."""
    outputs = "".join(f"output varying float ua{i} = 0; " for i in range(count))
    writes = "".join(f"ua{i} = (s + {i}) * t;\n" for i in range(count))  # no call, whose random numbers would be others
    parameters = "".join(f'<newparam sid="up{i}"><float>{i}</float></newparam>' for i in range(count))
    head, effect, rest = WALKER.partition('<effect id="planks-rsl">')
    rest = rest.replace("surface planks(", "surface planks(" + outputs, 1)
    return head + effect + parameters + rest.replace("normal Nf =", writes + "normal Nf =", 1)


class UnusedContent(ProgramTest):
    base = None

    def counts(self, text, *words):
        scene = self.write("w.dae", text)
        out = self.expect(render(scene, "-o", "null", "--size", "96x54", "--spp", "1", "--frames", "2-4", "--stats=json",
                                 "-q", *words), 0).out
        stats = json.loads(out)
        return ({k: stats[k] for k in PER_SCENE}, [{k: f[k] for k in PER_FRAME} for f in stats["frames"]])

    def expect_no_more(self, text, *words, kernels=True):
        if UnusedContent.base is None:
            UnusedContent.base = self.counts(WALKER)
        scene, frames = self.counts(text, *words)
        self.assertEqual(frames, UnusedContent.base[1])
        if kernels:
            self.assertEqual(scene, UnusedContent.base[0])

    def run_counts(self, text, *words):
        """All counts of a scene's first frame."""
        stats = json.loads(self.expect(render(self.write("c.dae", text), "-o", "null", "--size", "32x32", "--spp", "1",
                                              "--lights", "scene", "--stats=json", "-q", *words), 0).out)
        return {**{k: stats[k] for k in PER_SCENE}, **{k: stats["frames"][0][k] for k in PER_FRAME}}

    def all_explained(self, text, section):
        return json.loads(self.expect(render(self.write("w.dae", text), "--explain=json", "-q"), 0).out)[section]

    def explained(self, text, section):
        return [r for r in self.all_explained(text, section) if r["modelled"]]

    def test_channels_that_nothing_shows(self):
        text = unused_animations(10000, 2)
        self.expect_no_more(text)
        self.assertEqual(self.explained(text, "animation"), self.explained(WALKER, "animation"))

    def test_effects_that_nothing_wears(self):
        self.expect_no_more(unused_effects(1000))

    def test_images_that_no_shader_names(self):
        text = unused_images(200)
        write_pictures(self.folder, 200)
        self.expect_no_more(text)
        self.assertEqual(self.explained(text, "textures"), self.explained(WALKER, "textures"))

    def expect_nearly_the_same(self, text):
        _, base = self.counts(WALKER)
        _, frames = self.counts(text)
        for before, after in zip(base, frames):
            for name, count in before.items():
                self.assertLessEqual(abs(after[name] - count), count // 160, name)

    def test_meshes_that_others_hide(self):
        """Within a closed column."""
        self.expect_no_more(meshes_out_of_view(500, hidden=True), kernels=False)  # they have no material, which is one

    def test_meshes_out_of_view(self):
        """They move the scene's bounds, and so the rounding of positions: a few rays at edges may differ, and those
        that leave smooth surfaces are sent twice."""
        self.expect_nearly_the_same(meshes_out_of_view(500))

    def test_nodes_that_stand(self):
        self.expect_no_more(static_nodes(1000))

    def test_black_lights(self):
        self.expect_no_more(black_lights(100), kernels=False)
        off = [r for r in self.all_explained(black_lights(3), "lights") if r["why"] == "it is black at this time"]
        self.assertEqual(len(off), 3)

    def test_parameters_and_outputs_that_nothing_asks_for(self):
        self.expect_no_more(unused_parameters(1000))

    def test_lights_that_look_away(self):
        self.expect_no_more(lights_that_miss(100), kernels=False)  # those of spots are compiled

    def test_lights_of_another_category(self):
        """No loop of a shader asks for them: neither their kernels nor shadow rays run."""
        base, more = self.run_counts(one_lamp_and()), self.run_counts(one_lamp_and(*lamps(100, "fill")))
        for name in PER_FRAME:
            self.assertEqual(more[name], base[name], name)
        self.assertGreater(base["shadow_rays"], 0)
        asked = self.run_counts(one_lamp_and(*lamps(3, "key,fill")))
        self.assertEqual(asked["light_points"], 4 * base["light_points"])
        self.assertEqual(asked["shadow_rays"], 4 * base["shadow_rays"])

    # ---- what is never reached is never compiled, gathered or decoded

    def test_a_constant_shader_needs_nothing(self):
        counts = self.run_counts(document(CAMERA + WHITE + geometries(square()), EYE + place()))
        self.assertEqual(counts["kernels"], 2)  # of a frame and of a point
        for name in ("derivative_values", "texture_bytes", "vertices", "columns", "light_points", "shadow_rays",
                     "nested_rays"):
            self.assertEqual(counts[name], 0, name)

    def test_what_a_branch_never_reaches_is_not_there(self):
        """Du, a texture and lights behind a condition that is false at compile time."""
        png.write(self.folder / "red.png", 2, 2, [bytes([255, 0, 0] * 2)] * 2)
        code = ('surface s() {{ float on = {}; Oi = 1; Ci = 1; if (on > 0) Ci = Du(noise(P)) + texture("red.png") + '
                "diffuse(normalize(N)); }}")
        library, node = lamps(1, "key")

        def counts(on):
            return self.run_counts(document(CAMERA + rsl(code.format(on)) + geometries(square()) + library,
                                            EYE + place() + node))
        off, on = counts(0), counts(1)
        for name in ("derivative_values", "texture_bytes", "columns", "light_points", "shadow_rays"):
            self.assertEqual(off[name], 0, name)
            self.assertGreater(on[name], 0, name)
        self.assertLess(off["code_bytes"], on["code_bytes"])

    def test_vertices_move_where_joints_do(self):
        skin = controllers(one_joint_skin("square", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"))
        joint = '<node id="j" sid="j" type="JOINT"><translate sid="t">0 0 0</translate></node>'
        body = place(url="#skin", kind="controller", skeleton="<skeleton>#j</skeleton>")
        move = animations(animation("a", "j/t.X", [0, 1], [0, 1]))

        def vertices(more):
            text = document(CAMERA + WHITE + geometries(square()) + skin + more, EYE + joint + body)
            stats = json.loads(self.expect(render(self.write("v.dae", text), "-o", "null", "--size", "16x16", "--frames",
                                                  "0-2", "--stats=json", "-q"), 0).out)
            return [f["vertices"] for f in stats["frames"]]
        self.assertEqual(vertices(""), [4, 0, 0])  # placed once
        self.assertEqual(vertices(move), [4, 4, 4])


if __name__ == "__main__":
    main()
