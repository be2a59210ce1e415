"""tests/programs/render/render_changes_test.py: what kinora-render's command line changes of a scene:
--param, --hide, --only, --lights, --scale; and what --list says of it, as text and JSON."""
import json
import struct
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import MATTE, SOURCE, ProgramTest, main, render

sys.path.insert(0, str(SOURCE / "scripts/sheet"))
import png  # noqa: E402

SMALL = ("--spp", "4", "--progress", "none", "--threads", "2")

# Two squares side by side before an orthographic camera of [-2,2] x [-1,1]; constant colours, so
# that a pixel is its material. `group` holds the right one and another far off; a light `lamp`.
SQUARES = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><created>2026-01-01T00:00:00Z</created><modified>2026-01-01T00:00:00Z</modified></asset>
<library_cameras><camera id="cam"><optics><technique_common><orthographic><xmag>2</xmag><ymag>1</ymag>
<znear>0.1</znear><zfar>100</zfar></orthographic></technique_common></optics></camera></library_cameras>
<library_lights><light id="lamp"><technique_common><directional><color>1 1 1</color></directional>
</technique_common></light></library_lights>
<library_effects>
<effect id="red-fx"><profile_COMMON><technique sid="c"><constant><emission><color>1 0 0 1</color></emission>
</constant></technique></profile_COMMON></effect>
<effect id="grey-fx"><newparam sid="Kd"><float>0.5</float></newparam><profile_RSL><technique sid="r"><code>
surface flat(float Kd = 1; color tint = 1; string mode = "plain"; output varying color glow = 0;) {
    Oi = 1; Ci = Kd * tint; if (mode == "dark") Ci = 0; glow = Ci; }
</code><pass><shader stage="SURFACE"><name>flat</name><bind symbol="Kd"><param ref="Kd"/></bind></shader></pass>
</technique></profile_RSL></effect></library_effects>
<library_materials><material id="red" name="The red"><instance_effect url="#red-fx"/></material>
<material id="grey.1"><instance_effect url="#grey-fx"/></material></library_materials>
<library_geometries><geometry id="square"><mesh><source id="p"><float_array id="pa" count="12">
-1 -1 0 1 -1 0 1 1 0 -1 1 0</float_array><technique_common><accessor source="#pa" count="4" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common>
</source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="2" material="m"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2 0 2 3</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="vs">
<node id="eye"><translate>0 0 10</translate><instance_camera url="#cam"/></node>
<node id="sun"><instance_light url="#lamp"/></node>
<node id="left-id" name="left"><translate>-1 0 0</translate>GEOMETRY red</node>
<node id="group"><translate>1 0 0</translate><node id="right">GEOMETRY grey.1</node></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#vs"/></scene></COLLADA>
"""
INSTANCE = """<instance_geometry url="#square"><bind_material><technique_common>
<instance_material symbol="m" target="#{}"/></technique_common></bind_material></instance_geometry>"""


class Changes(ProgramTest):
    def setUp(self):
        super().setUp()
        text = SQUARES
        for name in ("red", "grey.1"):
            text = text.replace(f"GEOMETRY {name}", INSTANCE.format(name))
        self.scene = self.write("squares.dae", text)

    def picture(self, *words, scene=None, color="legacy"):
        out = self.folder / "a.png"
        self.expect(render(scene or self.scene, "-o", out, "--size", "32x16", "--color", color,
                           *SMALL, *words), 0)
        return png.read(out)

    def sides(self, *words, **options):
        """The middle pixels of the left and of the right square: r, g, b; None where nothing is."""
        width, height, rows = self.picture(*words, "--background=0,0,1", **options)
        def at(x):
            pixel = tuple(rows[height // 2][3 * x:3 * x + 3])
            return None if pixel == (0, 0, 255) else pixel
        return at(width // 4), at(3 * width // 4)

    def test_the_squares_are_red_and_grey(self):
        self.assertEqual(self.sides(), ((255, 0, 0), (128, 128, 128)))

    def test_params_reach_materials_by_id_name_and_glob(self):
        grey = ["grey.1.Kd=0.2", "grey*.Kd=0.2"]
        for param in grey:
            self.assertEqual(self.sides("--param", param), ((255, 0, 0), (51, 51, 51)))
        self.assertEqual(self.sides("--param", "grey.1.tint=1,0,0.5")[1], (128, 0, 64))
        self.assertEqual(self.sides("--param", "grey.1.tint=0.4")[1], (51, 51, 51))
        self.assertEqual(self.sides("--param", "grey.1.mode=dark")[1], (0, 0, 0))
        self.assertEqual(self.sides("--param", "The red.emission=0,1,0")[0], (0, 255, 0))
        self.assertEqual(self.sides("--param", "*.Kd=0.2")[1], (51, 51, 51))

    def test_a_color_of_the_file_is_a_display_value_and_a_param_is_light(self):
        scene = self.write("half.dae", self.scene.read_text().replace("1 0 0 1", "0.5 0.5 0.5 1"))
        # 255 * 0.5, and 255 * (1.055 * 0.5 ^ (1 / 2.4) - 0.055).
        self.assertEqual(self.sides(scene=scene, color="srgb"), ((128, 128, 128), (188, 188, 188)))
        self.assertEqual(self.sides("--param", "red.emission=0.5", scene=scene, color="srgb")[0],
                         (188, 188, 188))
        self.assertEqual(self.sides(scene=scene)[0], (128, 128, 128))

    def test_params_go_with_shaders_that_are_tried(self):
        words = ("--shader", f"red={self.write('f.sl', 'surface f(float k = 1;) { Ci = k; Oi = 1; }')}")
        self.assertEqual(self.sides(*words, "--param", "red.k=0.2")[0], (51, 51, 51))

    def test_params_of_lights(self):
        lit = self.write("lit.dae", self.scene.read_text().replace("constant>", "lambert>")
                         .replace("emission>", "diffuse>"))
        self.assertEqual(self.sides(scene=lit)[0], (255, 0, 0))  # it faces the light
        self.assertEqual(self.sides("--param", "lamp.lightcolor=0.2", scene=lit)[0], (51, 0, 0))

    def test_emission_is_a_factor_where_old_blender_wrote_it(self):
        text = self.scene.read_text().replace("constant>", "lambert>").replace("1 0 0 1", ".5 .5 .5 1").replace(
            "</emission>", "</emission><diffuse><color>0 .4 .8 1</color></diffuse>").replace(
            "<color>1 1 1</color></directional>", "<color>0 0 0</color></directional>")
        tool = "<contributor><authoring_tool>Blender 2.78.4</authoring_tool></contributor>"
        old = self.write("old.dae", text.replace("<asset>", "<asset>" + tool))
        self.assertEqual(self.sides("--lights", "scene", scene=old)[0], (0, 51, 102))
        self.assertEqual(self.sides("--lights", "scene", "--emission", "spec", scene=old)[0], (128, 128, 128))
        other = self.write("other.dae", text)
        self.assertEqual(self.sides("--lights", "scene", scene=other)[0], (128, 128, 128))

    def test_vertex_colors_tint_unless_they_are_off(self):
        colors = ('<source id="c"><float_array id="ca" count="4">0 .4 .8 0</float_array><technique_common>'
                  '<accessor source="#ca" count="1" stride="4"><param name="R" type="float"/><param name="G" type="float"/>'
                  '<param name="B" type="float"/><param name="A" type="float"/></accessor></technique_common></source>')
        text = self.scene.read_text().replace('<color>1 0 0 1', '<color>1 .5 .5 1').replace(
            '<vertices', colors + '<vertices').replace('offset="0"/><p>0 1 2 0 2 3', 'offset="0"/><input semantic="COLOR" '
                                                       'source="#c" offset="1"/><p>0 0 1 0 2 0 0 0 2 0 3 0')
        scene = self.write("colored.dae", text)
        self.assertEqual(self.sides(scene=scene), ((0, 51, 102), (128, 128, 128)))  # RSL reads them or not
        self.assertEqual(self.sides("--vertex-colors", "off", scene=scene), ((255, 128, 128), (128, 128, 128)))
        plain = self.write("plain.dae", text.replace('target="#red"', 'target="#gone"'))
        shade = ("--lights", "default")
        tinted, white = (self.sides(*shade, *words, scene=plain)[0] for words in ((), ("--vertex-colors", "off")))
        self.assertEqual(tinted[0], 0)
        self.assertEqual(len(set(white)), 1, white)

    def test_params_that_do_not_fit_are_explained(self):
        out = ("-o", self.folder / "b.png", *SMALL)
        rows = [("grey.1.kd=1", "did you mean 'Kd'?"), ("grey.1.nothing_near=1", "there are"),
                ("nobody.Kd=1", "no material and no light of the kind wanted matches 'nobody'"), ("grey.1.Kd=a", "a float takes 1 number"),
                ("grey.1.tint=1,2", "a color takes 3 numbers, not '1,2'"), ("Kd=1", "MATERIAL.NAME=VALUE"),
                ("grey.1.Kd", "MATERIAL.NAME=VALUE"), ("grey.1.Kd=nan", "a float takes 1 number")]
        for param, text in rows:
            with self.subTest(param=param):
                self.expect(render(self.scene, *out, "--param", param), 2, text)
        self.assertFalse((self.folder / "b.png").exists())

    def test_nodes_are_hidden_with_all_below_and_chosen_alone(self):
        left, right = (255, 0, 0), (128, 128, 128)
        rows = [(("--hide", "left"), (None, right)), (("--hide", "left-id"), (None, right)),
                (("--hide", "group"), (left, None)), (("--hide", "r*"), (left, None)),
                (("--only", "group"), (None, right)), (("--only", "left"), (left, None)),
                (("--only", "left", "--only", "right"), (left, right)),
                (("--only", "group", "--hide", "right"), (None, None))]
        for words, expected in rows:
            with self.subTest(words=words):
                self.assertEqual(self.sides(*words), expected)
        out = ("-o", self.folder / "b.png", *SMALL)
        self.expect(render(self.scene, *out, "--hide", "nobody"), 2, "no node matches 'nobody'")
        self.expect(render(self.scene, *out, "--only", "nobody"), 2, "no node matches 'nobody'")

    def lights(self, *words):
        listed = render(self.scene, "--list", "lights", "--json", *words)
        return [row["name"] for row in json.loads(self.expect(listed, 0).out)["lights"]]

    def test_lights_are_the_scenes_the_default_ones_or_both(self):
        default = ["default key light", "default fill light", "default rim light"]
        self.assertEqual(self.lights(), ["lamp"])
        self.assertEqual(self.lights("--lights", "scene"), ["lamp"])
        self.assertEqual(self.lights("--lights", "default"), default)
        self.assertEqual(self.lights("--lights", "both"), ["lamp", *default])
        self.assertEqual(self.lights("--hide", "sun"), default)
        self.assertEqual(self.lights("--hide", "sun", "--lights", "scene"), [])

    def test_exposure_makes_brighter_and_darker_what_is_there(self):
        dim = ("--param", "grey.1.Kd=0.2", "--param", "The red.emission=0.2,0,0")
        for words, level in (((), 51), (("--exposure", "1"), 102), (("--exposure", "-1"), 26),
                             (("--exposure=+0.5",), 72), (("--exposure", "auto"), 155)):
            with self.subTest(words=words):  # auto: 0.2 becomes 0.6, to a tenth of a stop
                self.assertEqual(self.sides(*dim, *words), ((level, 0, 0), (level,) * 3))
        self.assertEqual(self.sides("--exposure", "3", "--hide", "left")[0], None)  # the background
        out = ("-o", self.folder / "b.png", *SMALL)
        self.expect(render(self.scene, *out, "--exposure", "auto", "-v"), 0, "EXPOSURE_AUTO")
        for wrong in ("bright", "1,2", "nan", "1e9"):
            self.expect(render(self.scene, *out, f"--exposure={wrong}"), 2, "--exposure")

    def test_the_size_is_scaled(self):
        for words, size in ((("--scale", "50%"), (16, 8)), (("--scale=0.25",), (8, 4)),
                            (("--scale", "200%"), (64, 32))):
            self.picture(*words)
            head = (self.folder / "a.png").read_bytes()[16:24]
            self.assertEqual(struct.unpack(">II", head), size)
        self.expect(render(self.scene, "-o", "b.png", "--scale", "0"), 2, "--scale")
        self.expect(render(self.scene, "-o", "b.png", "--scale", "half"), 2, "50% or 0.5")

    def test_what_is_changed_makes_another_picture_for_skip_existing(self):
        words = ("-o", self.folder / "f.#.png", "--frames", "1", "--size", "16x8", "--spp", "1",
                 "--skip-existing", "--stats=json")
        def skipped(*more):
            stats = json.loads(self.expect(render(self.scene, *words, *more), 0).out)
            return stats["frames"][0]["state"] == "kept"
        for more in ((), ("--exposure", "1"), ("--exposure", "auto"), ("--param", "grey.1.Kd=1"), ("--hide", "left"), ("--only", "left"),
                     ("--lights", "both")):
            self.assertFalse(skipped(*more))
            self.assertTrue(skipped(*more))


class Shaders(Changes):
    """--shader, --atmosphere and --imager: files, and shaders of ours by name."""

    def test_a_surface_of_ours_by_name(self):
        by_file = self.picture("--shader", f"*={SOURCE}/assets/shaders/surface/checks.sl")
        by_name = self.picture("--shader", "*=checks")
        self.assertEqual(by_file, by_name)
        self.assertNotEqual(by_name, self.picture())

    def test_a_light_by_its_id(self):
        # It shines along the view on white matte squares: Ci = Cl.
        lamp = self.write("lamp.sl", 'light lamp(float k = 1) { solar(vector "world" (0, 0, -1), 0)'
                          " Cl = k * color(0.2, 0.4, 1); }")
        white = self.write("white.sl", "surface white() { Oi = 1; Ci = diffuse(normalize(N)); }")
        words = ("--shader", f"*={white}", "--shader", f"lamp={lamp}")
        self.assertEqual(self.sides(*words)[0], (51, 102, 255))
        self.assertEqual(self.sides(*words, "--param", "lamp.k=0.5")[0], (26, 51, 128))

    def test_a_light_on_a_material_makes_its_geometry_shine(self):
        lamp = self.write("glow.sl", "light glow() { illuminate(P, N, PI / 2) Cl = 1; }")
        lights = json.loads(self.expect(render(
            self.scene, "--shader", f"red={lamp}", "--list", "lights", "--json"), 0).out)["lights"]
        self.assertEqual(sorted(row["area"] for row in lights), [False, True])

    def test_default_lights_have_params_and_shaders_too(self):
        # With the fill and the rim light off, the squares facing the eye get the key light's red alone.
        white = self.write("white.sl", "surface white() { Oi = 1; Ci = diffuse(normalize(N)); }")
        words = ("--lights", "default", "--shader", f"*={white}")
        plain = self.sides(*words)[0]
        red = self.sides(*words, "--param", "default key light.lightcolor=0.5,0,0",
                         "--param", "default fill light.lightcolor=0", "--param", "default rim light.lightcolor=0")[0]
        self.assertGreater(min(plain), 0)
        self.assertGreater(red[0], 0)
        self.assertEqual(red[1:], (0, 0))
        off = self.write("off.sl", "light off() { solar(vector \"camera\" (0, 0, 1), 0) Cl = 0; }")
        self.assertEqual(self.sides(*words, "--shader", f"default*={off}")[0], (0, 0, 0))
        listed = self.expect(render(MATTE, "--list", "params"), 0).out
        self.assertIn("param default key light.lightcolor (color, of collada_directional)", listed)

    def test_an_atmosphere_lies_between_eye_and_surface(self):
        veil = self.write("veil.sl", "volume veil(float k = 1) { Ci = k * color(0, 1, 0); Oi = 1; }")
        self.assertEqual(self.sides("--atmosphere", veil), ((0, 255, 0), (0, 255, 0)))
        self.assertEqual(self.sides("--atmosphere", veil, "--param", "veil.k=0.2")[0], (0, 51, 0))
        self.assertEqual(self.sides("--atmosphere", "none"), self.sides())

    def test_what_is_not_there_is_refused_with_a_hint(self):
        fog = self.write("fog.sl", "volume fog() { Ci = 0; Oi = 0; }")
        for words, *said in (
                (("--shader", "*=plastik"), "SHADER_UNKNOWN", "did you mean 'plastic'?"),
                (("--shader", "*=tonemap"), "SHADER_OF_OTHER_KIND", "surface"),
                (("--imager", fog), "SHADER_OF_OTHER_KIND", "imager"),
                (("--atmosphere", "plastic"), "SHADER_OF_OTHER_KIND", "volume"),
                (("--shader", "nosuch=plastic"), "MATERIAL_UNKNOWN", "nosuch")):
            self.expect(render(self.scene, "-o", "b.png", *words), 2, *said)

    def test_ours_are_listed_by_kind(self):
        text = self.expect(render(self.scene, "--list", "shaders"), 0).out
        for line in ("ours: surface plastic", "ours: imager tonemap", "ours: volume haze",
                     "ours: light candle"):
            self.assertIn(line + "\n", text)


class Lists(Changes):
    def test_every_kind_is_there_as_text_and_as_json(self):
        kinds = ("cameras", "clips", "materials", "shaders", "params", "aovs", "lights", "nodes")
        every = json.loads(self.expect(render(self.scene, "--list", "--json"), 0).out)
        self.assertEqual(sorted(every), sorted((*kinds, "added")))
        text = self.expect(render(self.scene, "--list"), 0).out
        for kind in ("shaders", "aovs"):  # ours too, and those of every material
            text += self.expect(render(self.scene, "--list", kind), 0).out
        for kind in kinds:
            one = json.loads(render(self.scene, "--list", kind, "--json").out)
            self.assertEqual(one[kind], every[kind])
            for line in render(self.scene, "--list", kind).out.splitlines():
                self.assertIn(line, text)
        self.assertEqual([m["name"] for m in every["materials"]], ["red", "grey.1"])
        self.assertEqual(every["aovs"], [{"name": "glow", "type": "color", "shader": "flat"}])
        self.assertEqual([n["path"] for n in every["nodes"]],
                         ["eye", "sun", "left-id", "group/right"])

    def test_params_are_what_the_option_takes(self):
        names = [p["name"] for p in json.loads(render(self.scene, "--list", "params", "--json").out)["params"]]
        self.assertEqual(sorted(n for n in names if n.startswith("grey")),
                         ["grey.1.Kd", "grey.1.glow", "grey.1.mode", "grey.1.tint"])
        self.assertTrue(any(n.startswith("lamp.") for n in names), names)
        for name in names:
            with self.subTest(name=name):
                kind = next(p["type"] for p in json.loads(
                    render(self.scene, "--list", "params", "--json").out)["params"] if p["name"] == name)
                value = "x" if "string" in kind else "1" if "matrix" not in kind else "1 " * 16
                self.picture("--param", f"{name}={value}")

    def test_what_was_added_is_described(self):
        added = self.expect(render(MATTE, "--list", "cameras"), 0, "yfov 37", "left shoulder", "no highlights").out
        self.assertIn("default camera", added)
        self.assertEqual(json.loads(render(self.scene, "--list", "--json").out)["added"], [])


if __name__ == "__main__":
    main()
