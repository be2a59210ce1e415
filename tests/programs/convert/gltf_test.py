#!/usr/bin/env python3
"""tests/programs/convert/gltf_test.py: kinora-render of .glb and .gltf, as a user would run it."""
import base64
import json
import struct
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import SHADERS, SOURCE, ProgramTest, main, render, run

BENDER = SOURCE / "assets/gltf/bender.glb"


def parts(glb):
    """JSON and binary chunk of a .glb."""
    data = glb.read_bytes()
    size = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:20 + size]), data[28 + size:]


def pixels(png):
    """What a PNG shows: its IDAT chunks, without the texts (a fingerprint is one)."""
    data, at, shown = png.read_bytes(), 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        if kind == b"IDAT":
            shown += data[at + 8:at + 8 + size]
        at += size + 12
    return shown


class Gltf(ProgramTest):
    def picture(self, scene, *args):
        file = self.folder / "f.png"
        result = render(scene, "-o", file, "--size", "64x48", *args)
        self.assertEqual(result.code, 0, result.err)
        return pixels(file)

    def test_list_names_cameras_clips_and_lights(self):
        text = render(BENDER, "--list", "all").out
        self.assertIn("camera Camera", text)
        self.assertIn("clip ", text)
        self.assertIn("gltf_directional", text)
        self.assertIn("surface gltf_pbr", text)

    def test_a_scene_whose_nodes_are_not_there_is_unreadable(self):
        for nodes, roots, said in (({}, [0], "node 0 is not there"), ({"nodes": [{"name": "a"}]}, [5], "node 5 is not there"),
                                   ({"nodes": {"a": 1}}, [0], "'nodes' is not an array"),
                                   ({"nodes": [{}]}, [4294967295], "node 4294967295 is not there")):
            with self.subTest(said):
                scene = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": roots}], **nodes}
                file = self.write("s.gltf", json.dumps(scene))
                self.expect(render(file, "-o", self.folder / "s.png"), 3, said)
                self.expect(run("kinora-convert", file, self.folder / "s.dae"), 3, said)
                self.assertFalse((self.folder / "s.dae").exists())

    def test_frames_move_and_a_picture_repeats(self):
        first, again = (self.picture(BENDER, "--frames", "1") for _ in range(2))
        self.assertEqual(first, again)
        self.assertNotEqual(first, self.picture(BENDER, "--frames", "25"))

    def test_a_clip_plays_alone(self):
        clips = [line.split()[1] for line in render(BENDER, "--list", "clips").out.splitlines()
                 if line.startswith("clip ")]
        self.assertGreaterEqual(len(clips), 2)
        pictures = {self.picture(BENDER, "--clip", clip, "--time", "1") for clip in clips}
        self.assertEqual(len(pictures), len(clips))
        self.assertEqual(render(BENDER, "--clip", "none such", "--list", "clips").code, 2)

    def test_a_camera_is_chosen_by_its_name(self):
        self.picture(BENDER, "--frames", "1", "--camera", "Camera")
        result = render(BENDER, "--camera", "Nobody", "-o", self.folder / "x.png", "--frames", "1")
        self.assertEqual(result.code, 2)

    def test_a_shader_is_put_on_a_material(self):
        plain = self.picture(BENDER, "--frames", "1")
        checks = SHADERS / "surface/checks.sl"
        self.assertNotEqual(plain, self.picture(BENDER, "--frames", "1", "--shader",
                                                f"clay={checks}"))

    def test_gltf_with_files_beside_it_is_the_same_picture(self):
        tree, binary = parts(BENDER)
        (self.folder / "all data.bin").write_bytes(binary)
        tree["buffers"][0]["uri"] = "all%20data.bin"
        (self.folder / "s.gltf").write_text(json.dumps(tree))
        expected = self.picture(BENDER, "--frames", "13")
        self.assertEqual(self.picture(self.folder / "s.gltf", "--frames", "13"), expected)
        tree["buffers"][0]["uri"] = ("data:application/octet-stream;base64," +
                                     base64.b64encode(binary).decode())
        (self.folder / "t.gltf").write_text(json.dumps(tree))
        self.assertEqual(self.picture(self.folder / "t.gltf", "--frames", "13"), expected)

    def test_what_cannot_be_shown_is_said_with_its_place(self):
        tree, _ = parts(BENDER)
        tree["buffers"][0]["uri"] = "missing.bin"
        scene = self.folder / "s.gltf"
        scene.write_text(json.dumps(tree))
        result = render(scene, "-o", self.folder / "x.png", "--frames", "1")
        self.assertEqual(result.code, 3)
        self.assertIn("missing.bin", result.err)
        self.assertIn("GLTF_BUFFER_FILE", result.err)
        tree["extensionsRequired"] = ["KHR_draco_mesh_compression"]
        scene.write_text(json.dumps(tree))
        result = render(scene, "-o", self.folder / "x.png", "--frames", "1")
        self.assertEqual(result.code, 3)
        self.assertIn("KHR_draco_mesh_compression", result.err)
        scene.write_text('{"asset": {"version": "2.0"},\n "nodes": [}')
        result = render(scene, "-o", self.folder / "x.png", "--frames", "1")
        self.assertEqual(result.code, 3)
        self.assertIn("s.gltf:2:", result.err)

    def test_other_versions_are_refused(self):
        tree, binary = parts(BENDER)
        tree["buffers"][0]["uri"] = ("data:application/octet-stream;base64," +
                                     base64.b64encode(binary).decode())
        for asset, text in (({"version": "1.0"}, "its version is 1.0"),
                            ({"version": "2.0", "minVersion": "2.1"}, "a reader of version 2.1")):
            tree["asset"] = asset
            scene = self.write("v.gltf", json.dumps(tree))
            result = render(scene, "-o", self.folder / "v.png", "--frames", "1")
            self.assertEqual(result.code, 3, result)
            self.assertIn(text, result.err)

    def test_a_missing_texture_is_an_error_when_strict(self):
        tree, binary = parts(BENDER)
        tree["buffers"][0]["uri"] = ("data:application/octet-stream;base64," +
                                     base64.b64encode(binary).decode())
        tree["images"], tree["textures"] = [{"uri": "none.png"}], [{"source": 0}]
        for material in tree["materials"]:
            material.setdefault("pbrMetallicRoughness", {})["baseColorTexture"] = {"index": 0}
        scene = self.write("t.gltf", json.dumps(tree))
        words = (scene, "-o", self.folder / "t.png", "--frames", "1", "--size", "32x24", "--spp", "1")
        for strict, code in (((), 0), (("--strict",), 5)):
            (self.folder / "t.png").unlink(missing_ok=True)
            result = render(*words, *strict)
            self.assertEqual(result.code, code, result)
            self.assertIn("IMAGE_UNREADABLE", result.err)
            self.assertEqual((self.folder / "t.png").exists(), code == 0)

    def test_rsl_in_extras_is_the_surface(self):
        tree, binary = parts(BENDER)
        tree["buffers"][0]["uri"] = "b.bin"
        (self.folder / "b.bin").write_bytes(binary)
        for material in tree["materials"]:
            material["extras"] = {"kinora_rsl": {
                "surface": {"file": "flat.sl"}, "params": {"tint": [0.0, 1.0, 0.0]}}}
        (self.folder / "flat.sl").write_text("surface flat(color tint = 1;) { Oi = 1; Ci = tint; }")
        (self.folder / "s.gltf").write_text(json.dumps(tree))
        result = render(self.folder / "s.gltf", "--list", "materials")
        self.assertIn("surface flat", result.out, result.err)


if __name__ == "__main__":
    main()
