"""tests/programs/render/explain_test.py: kinora-render --explain, by switching each cause off."""
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import SCENES, ProgramTest, main, render
from written_scenes import (CAMERA, EYE, WHITE, animation, animations, controllers, document, geometries, morph,
                            one_joint_skin, place, png, rsl, source, square)

NOISE = "surface s() { Oi = 1; Ci = noise(P); }"
FILTERED = "surface s() { Oi = 1; Ci = filterstep(0.5, s); }"
CUT = "surface s() { Oi = step(0.5, s); Ci = Oi; }"
LIGHT = ('<library_lights><light id="sun"><technique_common><{0}><color>1 1 1</color></{0}></technique_common></light>'
         '</library_lights>', '<node id="sun-node"><instance_light url="#sun"/></node>')


LIT = rsl("surface s() { Oi = 1; Ci = diffuse(normalize(N)); }")
JOINT = '<node id="j" sid="j" type="JOINT"><rotate sid="r">1 0 0 0</rotate></node>'
SKIN = controllers(one_joint_skin("square", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"))
SKINNED = place(url="#skin", kind="controller", skeleton="<skeleton>#j</skeleton>")
FAR = ('<node id="far"><translate>0 0 50</translate><rotate>1 0 0 180</rotate><instance_light url="#lamp"/></node>')


def lamp(kind="<point><color>1 1 1</color></point>", extra=""):
    return f'<library_lights><light id="lamp"><technique_common>{kind}</technique_common>{extra}</light></library_lights>'


def lamp_shader(code):
    """A light of a shader, and its effect."""
    effect = (f'<effect id="lamp-fx"><profile_RSL><technique sid="t"><code><![CDATA[{code}]]></code><pass>'
              '<shader stage="LIGHT"/></pass></technique></profile_RSL></effect>')
    extra = '<extra><technique profile="RSL"><instance_effect url="#lamp-fx"/></technique></extra>'
    return f"<library_effects>{effect}</library_effects>" + lamp(extra=extra)


def of_scene(stage, code):
    """An effect of the whole scene: libraries, and what stands in <visual_scene>."""
    effect = (f'<library_effects><effect id="whole"><profile_RSL><technique sid="t"><code><![CDATA[{code}]]></code><pass>'
              f'<shader stage="{stage}"/></pass></technique></profile_RSL></effect></library_effects>')
    return effect, '<extra><technique profile="RSL"><instance_effect url="#whole"/></technique></extra>'


def displaced(amount):
    return rsl("surface s() { Oi = 1; Ci = 1; }").replace(
        "</pass>", '<shader stage="DISPLACEMENT"/></pass>').replace(
        "]]>", f"displacement d() {{ P += {amount} * normalize(N); }}]]>")


class Explain(ProgramTest):
    def explained(self, scene, *words):
        """Section -> rows."""
        return json.loads(self.expect(render(scene, "--explain=json", "-q", *words), 0).out)

    def written(self, look=WHITE, more="", nodes="", node=None):
        text = document(CAMERA + look + geometries(square()) + more, EYE + (node or place()) + nodes)
        return self.write("s.dae", text)

    def row(self, rows, section, text):
        """The rows of a section whose words hold the text."""
        return [r for r in rows.get(section, []) if text in f"{r['subject']}: {r['what']}; {r['why']}"]

    def test_derivatives_and_opacity_are_told_by_the_kernels(self):
        plain = self.explained(self.written(rsl(NOISE)))
        self.assertFalse(self.row(plain, "shaders", "no derivatives")[0]["modelled"])
        self.assertFalse(self.row(plain, "shaders", "no kernel for shadow rays")[0]["modelled"])
        filtered = self.explained(self.written(rsl(FILTERED)))
        self.assertTrue(self.row(filtered, "shaders", "derivatives of s")[0]["modelled"])
        cut = self.explained(self.written(rsl(CUT)))
        self.assertTrue(self.row(cut, "shaders", "a kernel of its own for shadow rays")[0]["modelled"])

    def test_globals_are_those_that_a_kernel_reads(self):
        for code, read in ((NOISE, "P"), (FILTERED, "s")):
            rows = self.explained(self.written(rsl(code)))
            what = self.row(rows, "shaders", "computed at each point")[0]["what"]
            self.assertIn(read, what.split(": ")[1].split())
            self.assertNotIn("N", what.split(": ")[1].split())

    def test_meshes_stand_or_move(self):
        standing = self.explained(self.written())
        self.assertFalse(self.row(standing, "meshes", "stands")[0]["modelled"])
        self.assertEqual(self.row(standing, "animation", "evaluated each frame"), [])
        channel = animations(animation("a", "node/t.X", [0, 1], [0, 1]))
        moving = self.explained(self.written(more=channel, node=place('<translate sid="t">0 0 0</translate>')))
        self.assertTrue(self.row(moving, "meshes", "moves")[0]["modelled"])
        self.assertEqual(self.row(moving, "animation", "evaluated each frame")[0]["subject"], "1 channels")

    def test_lights_are_told_with_what_they_do_not_need(self):
        for kind, shadows in (("directional", True), ("ambient", False)):
            libraries, node = LIGHT[0].format(kind), LIGHT[1]
            rows = self.explained(self.written(rsl("surface s() { Oi = 1; Ci = diffuse(N) + ambient(); }"), libraries, node),
                                  "--lights", "scene")
            self.assertEqual(bool(self.row(rows, "lights", "no shadow rays")), not shadows, rows["lights"])
        off = self.explained(self.folder / "s.dae", "--lights", "scene", "--shadows", "off")
        self.assertTrue(self.row(off, "lights", "sun"))

    def test_textures_are_those_that_were_opened(self):
        rows = self.explained(self.written(rsl(NOISE)))
        self.assertFalse(self.row(rows, "textures", "none is opened")[0]["modelled"])
        self.assertFalse(self.row(rows, "textures", "OpenImageIO")[0]["modelled"])

    def test_settings_name_who_set_them(self):
        rows = self.explained(self.written(), "--quality", "draft", "--spp", "9")
        self.assertEqual(self.row(rows, "settings", "spp")[0]["why"], "--spp")
        self.assertEqual(self.row(rows, "settings", "math")[0]["why"], "--quality draft")

    def expect_switched(self, on, off, section, words, *options):
        """The rows of both documents that hold the words: modelled with the cause, left out without it."""
        for cause, libraries in ((True, on), (False, off)):
            look, more, nodes, node = (*libraries, "", "", "")[:4]
            rows = self.explained(self.written(look, more, nodes, node or None), "--lights", "scene", *options)
            found = self.row(rows, section, words)
            self.assertEqual([row["modelled"] for row in found], [cause], (words, rows.get(section)))

    def test_each_pass_by_its_cause(self):
        mist = of_scene("VOLUME", "volume v() { Ci = Ci * .5; Oi = Oi; }")
        grey = of_scene("IMAGER", "imager i() { Ci = comp(Ci, 1); }")
        target = geometries(square("other", .5)) + controllers(morph("square", "other"))
        for words, on, off in (
                ("skins:", (WHITE, SKIN, JOINT, SKINNED), (WHITE,)),
                ("morphs:", (WHITE, target, "", place(url="#morph", kind="controller")), (WHITE, target)),
                ("displacement each frame:", (displaced("0.1 * sin(time)"),), (displaced("0.1"),)),
                ("nested rays:", (rsl("surface s() { Oi = 1; Ci = trace(P, vector(0, 0, 1)); }"),), (rsl(NOISE),)),
                ("nested rays:", (rsl("surface s() { Oi = 1; Ci = occlusion(P, N, 4); }"),), (WHITE,)),
                ("footprints:", (rsl(FILTERED),), (rsl(NOISE),)),
                ("opacity:", (rsl(CUT),), (rsl(NOISE),)),
                ("volumes:", (WHITE, *mist), (WHITE, mist[0])),
                ("imager:", (WHITE, *grey), (WHITE, grey[0]))):
            self.expect_switched(on, off, "passes", words)

    def lit(self, look, libraries, node, *options):
        """Rows of the material's lights: {what: modelled}, {what: why}."""
        rows = self.explained(self.written(look, libraries, node), "--lights", "scene", *options)["lights"]
        of_material = [row for row in rows if row["subject"] == "material mat"]
        return [(row["modelled"], row["what"].split(" by")[0], row["why"]) for row in of_material]

    def test_lights_reach_materials_or_tell_why_not(self):
        spot = "<spot><color>1 1 1</color><falloff_angle>20</falloff_angle></spot>"
        key = 'light l(string __category = "key";) { illuminate(point "shader" (0, 0, 0)) Cl = 1; }'
        asks = rsl('surface s() { Oi = 1; Ci = 0; illuminance("fill", P, N, PI / 2) Ci += Cl; }')
        near = '<node id="near"><translate>0 0 5</translate><instance_light url="#lamp"/></node>'
        reached = [(True, "lit", "1 of 1 lights")]
        self.assertEqual(self.lit(LIT, lamp(), near), reached)
        self.assertEqual(self.lit(LIT, lamp(spot), near), reached)
        self.assertEqual(self.lit(LIT, lamp(spot), FAR), [(False, "not lit", "it lies outside the light's cone or range")])
        self.assertEqual(self.lit(rsl(NOISE), lamp(), near), [(False, "not lit", "its shader asks for no light")])
        self.assertEqual(self.lit(asks, lamp_shader(key), near),
                         [(False, "not lit", "its shader asks for other categories")])
        self.assertEqual(self.lit(asks, lamp_shader(key.replace('"key"', '"key,fill"')), near), reached)
        self.assertEqual(self.lit(LIT, lamp("<ambient><color>1 1 1</color></ambient>"), near),
                         [(False, "not lit", "its shader does not ask for ambient light")])
        self.assertEqual(self.lit(rsl("surface s() { Oi = 1; Ci = ambient(); }"),
                                  lamp("<ambient><color>1 1 1</color></ambient>"), near), reached)

    def test_shadow_rays_are_left_out_for_a_reason(self):
        near = '<node id="near"><translate>0 0 5</translate><instance_light url="#lamp"/></node>'
        own = 'light l() { illuminate(point "shader" (0, 0, 0)) Cl = transmission(Ps, point "shader" (0, 0, 0)); }'

        def left_out(libraries, *options):
            rows = self.explained(self.written(LIT, libraries, near), "--lights", "scene", *options)
            return [row["why"] for row in self.row(rows, "lights", "no automatic shadow rays")]
        self.assertEqual(left_out(lamp()), [])
        self.assertEqual(left_out(lamp(), "--shadows", "off"), ["--shadows"])
        self.assertEqual(left_out(lamp_shader(own)), ["its shader asks for them itself"])

    def test_lights_that_are_not_placed(self):
        rows = self.explained(self.written(LIT, lamp(), FAR), "--lights", "default")
        self.assertEqual([r["modelled"] for r in self.row(rows, "lights", "never run")], [False], rows["lights"])
        placed = self.explained(self.written(LIT, lamp(), FAR), "--lights", "scene")
        self.assertEqual(self.row(placed, "lights", "never run"), [])

    def test_what_is_added_to_a_scene_without_it(self):
        text = document(WHITE + geometries(square()), place())
        self.assertTrue(self.row(self.explained(self.write("a.dae", text)), "added", "added")[0]["modelled"])
        with_both = self.explained(self.written(LIT, lamp(), FAR), "--lights", "scene")
        self.assertNotIn("added", with_both)

    def test_meshes_deform_by_a_skin_or_a_shader(self):
        for node, more, nodes, why in ((SKINNED, SKIN, JOINT, "skin 'skin' of 1 joints"), (None, "", "", "displacement reads")):
            look = displaced("0.1 * sin(time)") if node is None else WHITE
            rows = self.explained(self.written(look, more, nodes, node))
            self.assertTrue(self.row(rows, "meshes", why)[0]["modelled"], rows["meshes"])
        hidden = self.explained(self.written(nodes=place(id="b")), "--hide", "b")
        self.assertFalse(self.row(hidden, "meshes", "1 nodes with meshes")[0]["modelled"])

    def test_what_linear_blending_loses_of_a_twist(self):
        """A limb between two joints, one turned: half-way |cos(angle / 2)| of its radius is left."""
        skin = one_joint_skin("square", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1")
        skin = skin.replace(source("skin-j", "j", 1, "J", "name"), source("skin-j", "j k", 1, "J", "name"))
        identity = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"
        skin = skin.replace(source("skin-b", identity, 16), source("skin-b", f"{identity} {identity}", 16))
        skin = skin.replace(source("skin-w", [1], 1, "W"), source("skin-w", [.5], 1, "W"))
        skin = skin.replace("1 1 1 1 </vcount>", "2 2 2 2 </vcount>").replace("<v>" + "0 0 " * 4, "<v>" + "0 0 1 0 " * 4)
        for angle, left in ((0, "1 of"), (90, "0.707 of"), (180, None)):
            joints = ('<node id="root"><node id="j" sid="j" type="JOINT"/><node id="k" sid="k" type="JOINT">'
                      f'<rotate>1 0 0 {angle}</rotate></node></node>')
            node = SKINNED.replace("#j<", "#root<")
            scene = self.written(WHITE, controllers(skin), joints, node)
            words = ("-o", self.folder / "a.png", "--size", "8x8")
            what = self.row(self.explained(scene, *words), "meshes", "matrices are blended")[0]["what"]
            if left:
                self.assertIn(f"narrowed most, {left}", what)
            else:
                self.assertLess(float(what.split("narrowed most, ")[1].split()[0]), 1e-3)
            dual = self.explained(scene, "--skin", "dual", *words)
            self.assertTrue(self.row(dual, "meshes", "rotations are blended")[0]["modelled"])
            self.assertEqual(self.row(dual, "meshes", "matrices are blended"), [])

    def test_pictures_and_the_module_that_reads_them(self):
        png.write(self.folder / "red.png", 2, 2, [bytes([255, 0, 0] * 2)] * 2)
        (self.folder / "red.bmp").write_bytes(b"BM" + (70).to_bytes(4, "little") + bytes(4) + (54).to_bytes(4, "little") +
                                              (40).to_bytes(4, "little") + (2).to_bytes(4, "little") * 2 +
                                              (1).to_bytes(2, "little") + (24).to_bytes(2, "little") + bytes(24) +
                                              bytes([0, 0, 255] * 2 + [0, 0]) * 2)
        shown = ("-o", self.folder / "a.png", "--size", "8x8")  # textures are read where they are seen
        for name, module in (("red.png", False), ("red.bmp", True)):
            look = rsl(f'surface s() {{ Oi = 1; Ci = texture("{name}", s, t); }}')
            rows = self.explained(self.written(look), *shown)
            self.assertTrue(self.row(rows, "textures", f"{name}: read: 2 x 2")[0]["modelled"], rows["textures"])
            self.assertEqual(self.row(rows, "textures", "OpenImageIO: not loaded") == [], module)
        missing = self.explained(self.written(rsl('surface s() { Oi = 1; Ci = texture("none.png", s, t); }')), *shown)
        self.assertFalse(self.row(missing, "textures", "checks are shown")[0]["modelled"])

    def test_channels_that_do_not_reach_the_picture(self):
        channel = animations(animation("a", "node/t.X", [0, 1], [0, 1]), animation("b", "node/t.X", [0, 1], [5, 6]))
        rows = self.explained(self.written(more=channel, node=place('<translate sid="t">0 0 0</translate>')))
        self.assertTrue(self.row(rows, "animation", "1 channels: evaluated each frame")[0]["modelled"])
        self.assertFalse(self.row(rows, "animation", "1 channels: never evaluated")[0]["modelled"])

    def test_text_says_the_same_in_lines(self):
        out = self.expect(render(SCENES / "walker.dae", "--explain", "-q"), 0).out
        for section in ("settings", "meshes", "animation", "shaders", "lights", "textures", "passes"):
            self.assertRegex(out, rf"(?m)^{section}$")
        self.assertRegex(out, r"(?m)^  \+ .*: deforms")
        self.assertRegex(out, r"(?m)^  - .*: stands")

    def test_it_needs_no_picture_and_may_have_one(self):
        self.expect(render(self.written(), "-o", self.folder / "a.png", "--size", "8x8", "--explain", "-q"), 0, "settings")
        self.assertTrue((self.folder / "a.png").exists())


if __name__ == "__main__":
    main()
