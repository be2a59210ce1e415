"""tests/programs/disguise_test.py: files that are something else than their names say are named for what they
are, whatever they were to be: a scene, a document that it links to, a buffer, a picture."""
import json

from programs import ProgramTest, main, render, run
from written_scenes import CAMERA, EYE, WHITE, document, geometries, place, square

POINTER = "version https://git-lfs.github.com/spec/v1\noid sha256:0123\nsize 335626\n"
SMALL = ("--size", "16x16", "--spp", "1", "--progress", "none")
PICTURED = WHITE.replace("<color>1 1 1 1</color>", '<texture texture="i" texcoord="T"/>').replace(
    "<library_effects>", "<library_images><image id=\"i\"><init_from>map.png</init_from></image></library_images>"
    "<library_effects>")
TRIANGLE = {"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "data.bin"}]}


class Disguises(ProgramTest):
    def said(self, scene, code, *texts):
        return self.expect(render(scene, "-o", self.folder / "a.png", *SMALL), code, *texts)

    def test_scenes_that_are_pointers(self):
        for kind in ("dae", "zae", "kmz", "gltf", "glb"):
            with self.subTest(kind):
                scene = self.write(f"scene.{kind}", POINTER)
                self.said(scene, 3, "it is a Git LFS pointer; run 'git lfs pull'")
                self.expect(run("kinora-convert", scene, self.folder / "out.glb"), 3, "Git LFS pointer")

    def test_what_scenes_name(self):
        self.write("data.bin", POINTER)
        self.said(self.write("scene.gltf", json.dumps(TRIANGLE)), 3, "Git LFS pointer")
        self.write("map.png", POINTER)
        self.said(self.write("scene.dae", document(PICTURED + CAMERA + geometries(square()), place() + EYE)), 0,
                  "map.png", "Git LFS pointer")
        self.write("part.dae", POINTER)
        linked = document(CAMERA + WHITE + geometries(square()),
                          EYE + place() + '<node id="n"><instance_node url="part.dae#x"/></node>')
        self.said(self.write("linked.dae", linked), 0, "part.dae", "Git LFS pointer")

    def test_other_containers(self):
        for kind, head, what in (("glb", b"PK\3\4", "zip archive"), ("gltf", b"\x1f\x8b", "gzip"),
                                 ("glb", b"BLENDER-v300", "Blender"), ("gltf", b"Kaydara FBX Binary", "FBX"),
                                 ("dae", b"BLENDER-v300", "Blender")):
            with self.subTest(what):
                scene = self.folder / f"other.{kind}"
                scene.write_bytes(head + bytes(64))
                self.said(scene, 3, what)


if __name__ == "__main__":
    main()
