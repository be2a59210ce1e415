"""tests/programs/render/cryptomatte_test.py: Cryptomatte by its specification, and in Blender's compositor."""
import json
import shutil
import struct
import subprocess
import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
sys.path.insert(0, str(Path(__file__).resolve().parent))
import exr_files
from programs import SCENES, ProgramTest, main, render

COURT = SCENES / "court.dae"
SIZE = ("--size", "64x48", "--spp", "16", "--time", "0")
MATTE_OF = """
import bpy, sys
picture, name, out = sys.argv[sys.argv.index("--") + 1:]
scene = bpy.context.scene
image = bpy.data.images.load(picture)
scene.render.resolution_x, scene.render.resolution_y = 64, 48
scene.render.resolution_percentage = 100
scene.use_nodes = True
tree = scene.node_tree
tree.nodes.clear()
crypto = tree.nodes.new("CompositorNodeCryptomatteV2")
crypto.source = "IMAGE"
crypto.image = image
crypto.layer_name = "crypto_object"
crypto.matte_id = name
final = tree.nodes.new("CompositorNodeComposite")
tree.links.new(crypto.outputs["Matte"], final.inputs["Image"])
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.render.filepath = out
bpy.ops.render.render(write_still=True)
"""


def murmur(text, seed=0):
    """MurmurHash3_x86_32 by its definition, in whole numbers."""
    data, h = text.encode(), seed
    rotate = lambda x, r: (x << r | x >> 32 - r) & 0xffffffff
    for i in range(0, len(data), 4):
        k = int.from_bytes(data[i:i + 4], "little")
        k = rotate(k * 0xcc9e2d51 & 0xffffffff, 15) * 0x1b873593 & 0xffffffff
        h ^= k
        if len(data) - i >= 4:
            h = (rotate(h, 13) * 5 + 0xe6546b64) & 0xffffffff
    h ^= len(data)
    for multiplier, shift in ((0x85ebca6b, 16), (0xc2b2ae35, 13)):
        h = (h ^ h >> shift) * multiplier & 0xffffffff
    return h ^ h >> 16


@unittest.skipUnless(exr_files.can_read(), "no python3-openimageio")
class Cryptomatte(ProgramTest):
    def setUp(self):
        super().setUp()
        self.picture = self.folder / "a.exr"
        self.expect(render(COURT, "-o", self.picture, *SIZE, "--aov", "crypto_object,crypto_material"), 0)
        self.file = exr_files.read(self.picture)

    def layer(self, name):
        """Metadata of the layer, without the key."""
        key = f"cryptomatte/{murmur(name):08x}"[:len("cryptomatte/") + 7]
        return {t.rsplit("/", 1)[1]: v for t, v in self.file["texts"].items() if t.startswith(key + "/")}

    def coverage(self, layer, id_hex):
        """Of each pixel, of the id with these bits."""
        wanted = struct.unpack("<f", struct.pack("<I", int(id_hex, 16)))[0]
        sums = [0.0] * (64 * 48)
        for rank in ("00", "01", "02"):
            for number, part in (("R", "G"), ("B", "A")):
                columns = (self.file["values"][f"{layer}{rank}.{c}"] for c in (number, part))
                for k, (found, covered) in enumerate(zip(*columns)):
                    if found == wanted:
                        sums[k] += covered
        return sums

    def test_metadata_are_those_of_the_specification(self):
        nodes = [n["path"] for n in json.loads(render(COURT, "--list", "nodes", "--json").out)["nodes"] if n["meshes"]]
        for name in ("crypto_object", "crypto_material"):
            said = self.layer(name)
            self.assertEqual((said["name"], said["hash"], said["conversion"]),
                             (name, "MurmurHash3_32", "uint32_to_float32"))
            for text, number in json.loads(said["manifest"]).items():
                bits = murmur(text)
                if bits >> 23 & 255 in (0, 255):
                    bits ^= 1 << 23
                self.assertEqual(number, f"{bits:08x}", text)
        self.assertEqual(sorted(json.loads(self.layer("crypto_object")["manifest"])), sorted(nodes))

    def test_coverage_adds_up_to_alpha(self):
        for name in ("crypto_object", "crypto_material"):
            sums = [0.0] * (64 * 48)
            for number in json.loads(self.layer(name)["manifest"]).values():
                sums = [a + b for a, b in zip(sums, self.coverage(name, number))]
            for got, alpha in zip(sums, self.file["values"]["A"]):
                self.assertAlmostEqual(got, alpha, delta=1e-3)  # alpha is half
            self.assertGreater(sum(sums), 100)

    def test_compressions_and_parts_keep_every_bit(self):
        many = self.folder / "b.exr"
        self.expect(render(COURT, "-o", many, *SIZE, "--aov", "crypto_object", "--parts", "many", "--compression", "dwaa"), 0)
        part = exr_files.read_parts(many)[1]
        for channel in part["channels"]:
            self.assertEqual(part["values"][channel], self.file["values"][channel])
        self.expect(render(COURT, "-o", many, *SIZE, "--aov", "crypto_object", "--compression", "b44"), 2, "AOV_LOSSY")
        self.expect(render(COURT, "-o", many, *SIZE, "--aov", "crypto_object:min"), 2, "AOV_FILTER_UNKNOWN")

    @unittest.skipUnless(shutil.which("blender"), "no blender")
    def test_blender_shows_the_same_mattes(self):
        manifest = json.loads(self.layer("crypto_object")["manifest"])
        by_size = sorted(manifest, key=lambda name: -sum(self.coverage("crypto_object", manifest[name])))
        for name in by_size[:2]:
            out = self.folder / "matte.exr"
            script = self.write("matte.py", MATTE_OF)
            done = subprocess.run(["blender", "-b", "--factory-startup", "-P", script, "--", self.picture, name, out],
                                  capture_output=True, text=True, timeout=300)
            self.assertTrue(out.exists(), done.stdout + done.stderr)
            matte = exr_files.read(out)["values"]["R"]
            self.assertEqual(len(matte), 64 * 48)
            for got, want in zip(matte, self.coverage("crypto_object", manifest[name])):
                self.assertAlmostEqual(got, want, delta=1e-4)


if __name__ == "__main__":
    main()
