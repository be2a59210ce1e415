"""tests/programs/collada_options_test.py: archives, other folders, and what overrides a file's tags."""
import os
import re
import sys
import tempfile
import zipfile
from pathlib import Path

from programs import SOURCE, TEST_DATA, ProgramTest, main, render

sys.path[:0] = [str(SOURCE / "tests/conformance")]
import dae  # noqa: E402

DEVIATIONS = TEST_DATA / "deviations"
SMALL = ("--size", "32x32", "--spp", "1", "--threads", "1", "--time", "0")


class ColladaTest(ProgramTest):
    def picture(self, scene, *words, code=0):
        out = self.folder / "picture.png"
        out.unlink(missing_ok=True)
        result = render(scene, "-o", out, *SMALL, *words)
        self.assertEqual(result.code, code, result)
        data = out.read_bytes() if out.exists() else b""
        # The pixels: the texts of the file hold its name.
        pixels = data[data.index(b"IDAT"):] if data else b""
        return pixels, result.err

    def write_bytes(self, name, data):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
        return path

    def zip(self, name, members):
        path = self.folder / name
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
            for member, content in members.items():
                archive.writestr(member, content)
        return path


class Overrides(ColladaTest):
    def test_transparency_auto_shows_what_the_formula_hides(self):
        scene = DEVIATIONS / "13_transparency.dae"
        opaque = self.write("opaque.dae", dae.plain(effects=dae.effect(
            "<phong><diffuse><color>.8 .5 .2 1</color></diffuse></phong>")))
        nothing, _ = self.picture(opaque, "--hide", "*")
        spec, said = self.picture(scene, "--transparency", "spec")
        auto, said_too = self.picture(scene)
        self.assertEqual(auto, self.picture(scene, "--transparency", "auto")[0])
        whole, _ = self.picture(opaque)
        self.assertEqual(spec, nothing)
        self.assertEqual(auto, whole)
        for text in (said, said_too):
            self.assertIn("FX_TRANSPARENT_ALL", text)

    def test_auto_leaves_what_is_seen_as_it_is(self):
        scene = TEST_DATA / "conformance/equal/opacities/rgb_zero.dae"
        self.assertEqual(self.picture(scene)[0], self.picture(scene, "--transparency", "spec")[0])

    def test_auto_keeps_the_mask_of_a_texture(self):
        """A leaf: alpha 0 and 255. A transparency of 0 hides all of it by the formula."""
        mask = dae.png([[(255, 255, 255, 0), (255, 255, 255, 255)]], 4)
        self.write_bytes("leaf.png", mask)
        leaf = dae.textured(path="leaf.png").replace(
            "</diffuse>", '</diffuse><transparent opaque="A_ONE"><texture texture="map-sampler" texcoord="UV"/>'
            "</transparent><transparency><float>{}</float></transparency>")
        right = self.write("right.dae", leaf.format(1))
        hidden = self.write("hidden.dae", leaf.format(0))
        whole = self.write("whole.dae", dae.textured(path="leaf.png"))
        self.assertEqual(self.picture(hidden)[0], self.picture(right)[0])
        self.assertIn("FX_TRANSPARENT_ALL", self.picture(hidden)[1])
        self.assertNotIn("FX_TRANSPARENT_ALL", self.picture(right)[1])
        self.assertNotEqual(self.picture(right)[0], self.picture(whole)[0])

    def test_up_stands_for_the_files_tag(self):
        scene = {up: self.write(f"{up}.dae", dae.plain(cameras="", eye="", up=f"{up}_UP")) for up in "XYZ"}
        pictures = {up: self.picture(scene[up])[0] for up in "XYZ"}
        self.assertEqual(len(set(pictures.values())), 3)
        for up in "XYZ":
            self.assertEqual(self.picture(scene["Y"], "--up", up)[0], pictures[up])

    def test_unit_stands_for_the_files_tag(self):
        holds = dict(scene=False, lights="", cameras="", materials="", effects="")
        self.write("part.dae", dae.document("", unit='meter="0.5"', **holds))
        node = dae.node(dae.shown("part.dae#house"))
        metre = self.write("metre.dae", dae.document(node, geometries=" "))
        half = self.write("half.dae", dae.document(node, geometries=" ", unit='meter="0.5"'))
        self.assertNotEqual(self.picture(metre)[0], self.picture(half)[0])
        self.assertEqual(self.picture(metre, "--unit", "0.5")[0], self.picture(half)[0])

    def test_a_clip_plays_its_range(self):
        turn = '<rotate sid="r">0 0 1 0</rotate>'
        scene = self.write("clips.dae", dae.document(
            dae.node(transforms=turn), animations=dae.animated("n/r.ANGLE", [0, 2], [(0,), (90,)]),
            clips='<animation_clip id="wave" start="0.5" end="0.625"><instance_animation url="#a"/>'
                  "</animation_clip>"))
        result = render(scene, "--clip", "wave", "--fps", "24", "-o", self.folder / "f.####.png",
                        "--size", "8x8", "--spp", "1")
        self.expect(result, 0)
        self.assertEqual(sorted(self.pictures()), [f"f.{n:04}.png" for n in (12, 13, 14, 15)])
        self.expect(render(scene, "--list", "clips"), 0, "clip wave 0.5 to 0.625 s", "range 0 to 2 s")

    def test_list_shows_what_was_added_to_a_bare_scene(self):
        bare = self.write("bare.dae", dae.plain(cameras="", eye="", lights="", light_nodes=""))
        self.expect(render(bare, "--list"), 0, "added: default camera", "added: default key light",
                    "added: default fill light", "added: default rim light")
        result = self.expect(render(self.write("full.dae", dae.plain()), "--list"), 0, "camera eye-node")
        self.assertNotIn("added", result.out)

    def test_evaluate_scene_chooses_the_camera_and_the_option_beats_it(self):
        scene = TEST_DATA / "conformance/differ/chosen_cameras/evaluated.dae"
        first = TEST_DATA / "conformance/differ/chosen_cameras/first.dae"
        self.expect(render(scene, "--list", "cameras"), 0, "camera side (eye) *")
        self.assertEqual(self.picture(scene, "--camera", "eye-node")[0], self.picture(first)[0])


class Folders(ColladaTest):
    def setUp(self):
        super().setUp()
        holds = dict(scene=False, lights="", cameras="", materials="", effects="")
        self.write("parts/house.dae", dae.document("", **holds))
        self.scene = self.write("scene/main.dae", dae.document(
            dae.node(dae.shown("../parts/house.dae#house")), geometries=" "))

    def test_what_lies_outside_is_read_only_when_its_folder_is_allowed(self):
        _, said = self.picture(self.scene, code=3)
        self.assertIn("LINK_OUTSIDE", said)
        self.assertIn("--allow-external", said)
        self.assertIn("SCENE_EMPTY", said)
        allowed, said = self.picture(self.scene, "--allow-external", self.folder / "parts")
        self.assertNotIn("LINK_OUTSIDE", said)
        self.picture(self.scene, "--allow-external", self.folder / "scene", code=3)
        two, _ = self.picture(self.scene, "--allow-external", self.folder / "scene",
                              "--allow-external", self.folder / "parts")
        self.assertEqual(two, allowed)
        self.picture(self.scene, "--allow-external", self.folder / "nowhere", code=2)

    def test_links_of_the_file_system_lead_to_pictures_alone(self):
        os.symlink(self.folder / "parts", self.folder / "scene/parts")
        scene = self.write("scene/linked.dae", self.scene.read_text().replace("../parts", "parts"))
        _, said = self.picture(scene, code=3)
        self.assertIn("LINK_OUTSIDE", said)
        self.write_bytes("secret/map.png", dae.png(dae.picture()))
        os.symlink(self.folder / "secret/map.png", self.folder / "scene/Map.PNG")
        scene = self.write("scene/textured.dae", dae.textured())
        followed, said = self.picture(scene)
        self.assertNotIn("error", said)
        confined, _ = self.picture(scene, "--confine")
        os.unlink(self.folder / "scene/Map.PNG")
        missing, _ = self.picture(scene)
        self.assertEqual(confined, missing)
        self.write_bytes("scene/map.png", dae.png(dae.picture()))
        self.assertEqual(self.picture(scene)[0], followed)
        self.assertNotEqual(followed, missing)

    def test_a_missing_part_is_a_finding_and_the_rest_renders(self):
        both = self.write("scene/both.dae", dae.document(
            dae.node() + dae.node(dae.shown("gone.dae#house"), id="n2")))
        alone = self.write("scene/alone.dae", dae.plain())
        seen, said = self.picture(both)
        self.assertIn("LINK_EXTERNAL_MISSING", said)
        self.assertIn("both.dae:", said)
        # A frame that lacked a part has no checksum: --skip-existing makes it again.
        whole = self.picture(alone)[0]
        self.assertEqual(seen, re.sub(rb"\0\0\0 tEXtkinora/checksum\0.{20}", b"", whole, flags=re.S))


class Archives(ColladaTest):
    def test_findings_name_the_member_and_nothing_stays_behind(self):
        broken = dae.textured(path="gone.png").replace('url="#eye"', 'url="#nobody"')
        scene = self.zip("a.zae", {"manifest.xml": "<dae_root>sub/scene.dae</dae_root>", "sub/scene.dae": broken})
        with tempfile.TemporaryDirectory() as temporary:
            out = self.folder / "a.png"
            result = render(scene, "-o", out, *SMALL, env=os.environ | {"TMPDIR": temporary})
            self.expect(result, 0, f"{scene}!sub/scene.dae:", "LINK_UNRESOLVED")
            self.assertNotIn(temporary, result.err)
            self.assertEqual(list(Path(temporary).iterdir()), [])

    def test_a_picture_of_an_archive_is_known_again(self):
        scene = self.zip("b.zae", {"scene.dae": dae.textured(), "map.png": dae.png(dae.picture())})
        words = ("-o", self.folder / "b.png", *SMALL, "--progress", "lines", "--skip-existing")
        self.expect(render(scene, *words), 0)
        before = (self.folder / "b.png").stat().st_mtime_ns
        self.expect(render(scene, *words), 0)
        self.assertEqual((self.folder / "b.png").stat().st_mtime_ns, before)

    def test_members_that_lead_out_are_refused_and_bombs_are_errors(self):
        scene = self.zip("c.zae", {"scene.dae": dae.plain(), "../../evil.txt": "x"})
        _, said = self.picture(scene)
        self.assertIn("ARCHIVE_MEMBER", said)
        self.assertFalse((self.folder / "../evil.txt").exists())
        bomb = self.zip("d.zae", {"scene.dae": dae.plain(), "zeros": bytes(160 << 20)})
        _, said = self.picture(bomb, code=3)
        self.assertIn("ARCHIVE_LIMIT", said)

    def test_what_only_looks_like_an_archive_is_an_error(self):
        _, said = self.picture(self.write_bytes("e.zae", b"PK\3\4 and nothing more"), code=3)
        self.assertIn("ARCHIVE_OPEN", said)
        _, said = self.picture(self.zip("f.zae", {"readme.txt": "x"}), code=3)
        self.assertIn("ARCHIVE_NO_SCENE", said)


if __name__ == "__main__":
    main()
