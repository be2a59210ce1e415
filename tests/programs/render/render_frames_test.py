"""tests/programs/render/render_frames_test.py: a frame is what the scene says of its time: clips, animated
matrices, values that overflow, what is missing or changed, and findings about all of it."""
import json
import time
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from programs import BIN, MATTE as MATTE_SCENE, SHADERS, main, render, run
from written_scenes import (CAMERA, EYE, MATTE, WHITE, SceneTest, animation, animations, camera, controllers, document,
                            geometries, mesh, morph, place, png, rsl, square)

import os
import subprocess

WHOLE = (256, 8, 23, 8, 23)
SQUARE = geometries(square())
MOVED = '<translate sid="t">0 0 0</translate>'


def clips(*rows):
    text = "".join(f'<animation_clip id="{name}" start="{start}" end="{end}"><instance_animation url="#{what}"/>'
                   "</animation_clip>" for name, start, end, what in rows)
    return f"<library_animation_clips>{text}</library_animation_clips>"


class Clips(SceneTest):
    TEXT = document(CAMERA + WHITE + SQUARE + animations(
        animation("walk", "node/t.X", [0, 1], [-1, -1]), animation("run", "node/t.X", [0, 1], [1, 1]),
        animation("rise", "node/t.Y", [0, 1], [0, 1])) + clips(("Walk", 0, 1, "walk"), ("Run", 0, 1, "run")),
        EYE + place(MOVED))

    def test_a_clip_plays_its_own_animations_and_those_of_no_clip(self):
        for name, left in (("Walk", 0), ("Run", 16)):
            self.render(self.TEXT, "--clip", name, "--frames", "12")
            self.assertEqual(self.box(), (256, left, left + 15, 4, 19), name)

    def test_skip_existing_asks_for_the_clip(self):
        text = document(CAMERA + WHITE + SQUARE + animations(animation("a", "node/t.X", [0, 1], [-1, 1])) +
                        clips(("A", 0, 1, "a"), ("B", 0, 2, "a")), EYE + place(MOVED))
        words = ("--frames", "0", "--skip-existing")
        self.render(text, "--clip", "A", *words)
        before = (self.folder / "a.png").stat().st_mtime_ns
        self.render(text, "--clip", "A", *words)
        self.assertEqual((self.folder / "a.png").stat().st_mtime_ns, before)
        self.render(text, "--clip", "B", *words)
        self.assertNotEqual((self.folder / "a.png").stat().st_mtime_ns, before)


class Textures(SceneTest):
    def paint(self, *colour):
        png.write(self.folder / "wall.png", 4, 4, [bytes(colour) * 4] * 4)
        stamp = time.time() + self.seconds  # another time of change, whatever the clock's grain
        self.seconds += 2
        os.utime(self.folder / "wall.png", (stamp, stamp))

    def test_skip_existing_sees_that_a_texture_has_changed_however_it_is_named(self):
        self.seconds = 0
        for code, binds in (('surface s() { Ci = texture("wall.png"); Oi = 1; }', ""),
                            ('surface s(string m = "wall.png";) { Ci = texture(m); Oi = 1; }', ""),
                            ('surface s(string m = "";) { Ci = texture(m); Oi = 1; }',
                             '<bind symbol="m"><string>wall.png</string></bind>')):
            text = document(CAMERA + rsl(code, "", binds) + SQUARE, EYE + place())
            self.paint(255, 0, 0)
            self.render(text)
            self.assertEqual(self.pixel(), (255, 0, 0))
            self.paint(0, 255, 0)
            self.render(text, "--skip-existing")
            self.assertEqual(self.pixel(), (0, 255, 0), code)


class Matrices(SceneTest):
    # A translation's x stands in row 0, column 3 of a column vector's matrix, in row 3, column 0 of RSL's.
    CODE = "surface s(matrix m = 1;) { Ci = color(comp(m, 3, 0), comp(m, 0, 3), comp(m, 0, 0)); Oi = 1; }"
    HALF, ONE = "1 0 0 0.5 0 1 0 0 0 0 1 0 0 0 0 1", "1 0 0 1 0 1 0 0 0 0 1 0 0 0 0 1"
    PARAM = f'<newparam sid="mm"><float4x4>{HALF}</float4x4></newparam>'
    REF = '<bind symbol="m"><param ref="mm"/></bind>'

    def at(self, moved, seconds, binds=REF, transforms="", inside=""):
        text = document(CAMERA + animations(*moved) + rsl(self.CODE, self.PARAM, binds) + SQUARE,
                        EYE + place(transforms, inside=inside))
        self.render(text, "--time", str(seconds))
        return self.pixel()

    def test_a_float4x4_is_animated_whole_and_by_elements(self):
        whole = [animation("a", "fx/mm", [0, 1], f"{self.HALF} {self.ONE}", 16)]
        element = [animation("a", "fx/mm(3)(0)", [0, 1], [0.5, 1])]
        for moved in (whole, element):
            for seconds, wanted in ((0, 128), (0.5, 191), (1, 255)):
                self.assertEqual(self.at(moved, seconds), (wanted, 0, 255), seconds)

    def test_binds_of_an_instance_turn_matrices_as_params_do(self):
        self.assertEqual(self.at([], 0), (128, 0, 255))
        bind = '<bind semantic="m" target="{}"/>'
        self.assertEqual(self.at([], 0, "", inside=bind.format("fx/mm")), (128, 0, 255))
        node = f'<matrix sid="x">{self.HALF}</matrix>'
        self.assertEqual(self.at([], 0, "", node, bind.format("node/x")), (128, 0, 255))


class Range(SceneTest):
    def test_a_range_without_end_is_refused_with_a_reason(self):
        for last in (1e9, 1e30):
            text = document(CAMERA + WHITE + SQUARE + animations(animation("a", "node/t.X", [0, last], [0, 1])),
                            EYE + place(MOVED))
            result = self.render(text, code=2, out="f.####.png")
            self.assertIn("choose with --frames or --time", result.err)
            self.render(text, "--frames", "0", out="f.####.png")


class Missing(SceneTest):
    def test_strict_counts_files_of_every_kind(self):
        lost = '<node><instance_{} url="nothere.dae#x"/></node>'
        points = 'surface s() { float x = 0; texture3d("nothere.ptc", P, N, "x", x); Ci = x; Oi = 1; }'
        for text in (document(CAMERA + WHITE + SQUARE, EYE + place() + lost.format("node")),
                     document(CAMERA + WHITE + SQUARE, EYE + place() + lost.format("geometry")),
                     document(CAMERA + rsl(points) + SQUARE, EYE + place())):
            self.render(text)
            self.render(text, "--strict", code=5)

    def test_what_is_missing_is_missing_in_all_frames(self):
        code = 'surface s() { Ci = texture("nothere.png"); Oi = 1; }'
        text = document(CAMERA + rsl(code) + SQUARE, EYE + place())
        self.render(text, "--strict", "--keep-going", "--frames", "0-2", code=1, out="f.####.png")
        self.assertEqual(list(self.folder.glob("f.*.png")), [])


class Overflow(SceneTest):
    def picture(self, text, frames):
        for file in self.folder.glob("f.*.png"):
            file.unlink()
        return self.render(text, "--frames", frames, out="f.####.png").err, self.box("f.0024.png")

    def test_a_matrix_that_overflows_hides_its_node_whatever_frame_came_before(self):
        nested = (EYE + '<node id="outer">' + MOVED + '<scale sid="s">1 1 1</scale>' +
                  place('<scale sid="s">1 1 1</scale>', id="inner") + "</node>")
        moved = [animation("m", "outer/t.X", [0, 1], [0, 1])]
        moved += [animation(n, f"{n}/s.X", [0, 1], [1, 1e200], 1, "STEP") for n in ("outer", "inner")]
        text = document(CAMERA + WHITE + SQUARE + animations(*moved), nested)
        for frames in ("24", "12,24", "0,12,24"):
            said, box = self.picture(text, frames)
            self.assertIsNone(box, frames)
            self.assertEqual(said.count("[NODE_SINGULAR]"), 1, said)

    def test_a_matrix_that_becomes_singular_is_told_once_in_any_frame(self):
        moved = animations(animation("m", "node/s.X", [0, 0.5, 1], [1, 0, 0]))
        text = document(CAMERA + WHITE + SQUARE + moved, EYE + place('<scale sid="s">1 1 1</scale>'))
        for frames in ("24", "0,24", "0,12,24"):
            said, box = self.picture(text, frames)
            self.assertIsNone(box, frames)
            self.assertEqual(said.count("[NODE_SINGULAR]"), 1, said)

    def test_vertices_that_overflow_are_told_once_in_any_frame(self):
        far = mesh("target", [-1, -1, 9, 1, -1, 9, 1, 1, 9, -1, 1, 9], [0, 1, 2, 0, 2, 3])
        moved = animations(animation("m", "morph-w(0)", [0, 1], [0, 1e38], 1, "STEP"))
        text = document(CAMERA + WHITE + geometries(square(), far) + controllers(morph("square", "target")) + moved,
                        EYE + place(url="#morph", kind="controller"))
        for frames in ("24", "0,24", "0,24,25"):
            said, box = self.picture(text, frames)
            self.assertIsNone(box, frames)
            self.assertEqual(said.count("[GEOMETRY_ISSUE]"), 1, said)


class Sizes(SceneTest):
    # A pixel is 1/16 of the square in u, whatever its size.
    CODE = "surface s() { Ci = color(8 * du, 8 * dv, 1); Oi = 1; }"

    def sized(self, size):
        cameras, eye = camera(unit=size)
        return self.render(document(cameras + rsl(self.CODE) + geometries(square(half=size)), eye + place())).err

    def test_derivatives_know_no_size(self):
        for size in (1, 1e-12, 1e-9, 3e9, 1e10, 1e11):
            said = self.sized(size)
            self.assertNotIn("SCENE_SIZE", said)
            red, green, blue = self.pixel()
            self.assertEqual(blue, 255, size)
            for value in (red, green):
                self.assertAlmostEqual(value, 127.5, delta=1, msg=f"{size}")

    def test_a_size_beyond_floats_is_told(self):
        for size in (1e-14, 1e13):
            self.assertIn("SCENE_SIZE", self.sized(size))


class Views(SceneTest):
    def test_a_camera_far_off_without_zfar_sees_the_scene(self):
        optics = "<perspective><yfov>0.05</yfov>{}</perspective>"
        text = [document(camera(optics.format(near), distance=4000)[0] + WHITE + SQUARE,
                         EYE.replace("0 0 5", "0 0 4000") + place()) for near in ("", "<znear>0.1</znear>")]
        self.render(text[0], out="whole.png")
        self.render(text[1])
        self.assertEqual(self.bytes_of("a.png"), self.bytes_of("whole.png"))
        self.assertIsNotNone(self.box())

    def test_an_animated_mesh_is_shaded_like_a_still_one(self):
        roof = mesh("square", [-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 0, 0, 0.5], [0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4])
        for code in ("Ci = 0.5 + 0.5 * vector normalize(N);", "Ci = 0.5 + color(Du(N)) * 0.05;"):
            surface = rsl("surface s() { normal n = N; " + code.replace("vector normalize(N)",
                          "color(xcomp(n), ycomp(n), zcomp(n)) / length(n)").replace("color(Du(N))",
                          "color(comp(Du(n), 0), comp(Du(n), 1), comp(Du(n), 2))") + " Oi = 1; }")
            node = EYE + place('<scale sid="s">1 1 8</scale>')
            self.render(document(CAMERA + surface + geometries(roof), node), out="still.png")
            moved = animations(animation("a", "node/s.Z", [0, 1], [8, 4]))
            self.render(document(CAMERA + surface + geometries(roof) + moved, node), "--time", "0")
            worst = max(abs(a - b) for p, q in zip(self.bytes_of("a.png"), self.bytes_of("still.png"))
                        for a, b in zip(p, q))
            self.assertLessEqual(worst, 1, code)
            self.assertGreater(len({tuple(row) for row in self.bytes_of("still.png")}), 1)  # it is no flat colour


class Memory(SceneTest):
    def test_material_groups_of_a_mesh_share_its_positions(self):
        """2000 groups of 6000 vertices: 192 MB if each had its own."""
        def text(groups):
            positions = [v for i in range(6000) for v in (i % 97 * 0.01, i % 89 * 0.01, i * i % 83 * 0.01)]
            whole = mesh("square", positions, [0, 1, 2])
            head, tail = whole.split("<triangles")
            end = tail[tail.index("</mesh>"):]
            rows = "".join(f'<triangles count="1" material="m"><input semantic="VERTEX" source="#square-v" offset="0"/>'
                           f"<p>{3 * i} {3 * i + 1} {3 * i + 2}</p></triangles>" for i in range(groups))
            return document(CAMERA + WHITE + geometries(head + rows + end), EYE + place())
        peaks = []
        for groups in (1, 2000):
            result = self.render(text(groups), "-q", "--stats=json")
            peaks.append(json.loads(result.out)["peak_memory_bytes"])
        self.assertLess(peaks[1] - peaks[0], 80e6, peaks)


class FullDisk(SceneTest):
    def test_what_does_not_reach_stdout_is_no_success(self):
        plastic = SHADERS / "plastic.sl"
        for program, *words in (("kinora-render", MATTE_SCENE, "--list", "cameras"),
                                ("kinora-render", MATTE_SCENE, "--list", "materials", "--json"),
                                ("kinora-render", MATTE_SCENE, "-o", self.folder / "b.png", "--size", "8x8", "--frames",
                                 "1", "--stats=json"),
                                ("kinora-shade", "info", plastic), ("kinora-shade", "manual", "noise"),
                                ("kinora-validate", "--print-schema", "1.4.1"), ("kinora-validate", "--list-rules")):
            words = [str(w) for w in words]
            self.assertEqual(run(program, *words).code, 0, words)
            with open("/dev/full", "w") as full:
                done = subprocess.run([str(BIN / program), *words], stdout=full, stderr=subprocess.PIPE, text=True,
                                      timeout=60)
            self.assertEqual(done.returncode, 6, words)
            self.assertIn("cannot write to stdout", done.stderr)


if __name__ == "__main__":
    main()
