"""tests/programs/shade/public_classes_test.py: class shaders in the manner of public ones, those of tests/rsl/classes that
begin with pub_, over points: the numbers are arithmetic by hand."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
from points_test import Points
from programs import SOURCE, main

SUN = "light sun(color tint = 1;) { solar(vector \"shader\" (0, 0, -1), 0) Cl = tint; }"
CASES = [
    ("pub_layered", {"parameters": {"baseLayer": "p1", "topLayers": ["p2"]}, "variables": {"N": [0, 0, 1], "I": [0, 0, -1]}}, {"Ci": [[0.75, 0.75, 0.25]]}, [("p1", "pub_co_paint", {"tint": [1, 0, 0]}), ("p2", "pub_co_paint", {"tint": [0, 1, 0], "amount": 0.5})]),
    ("pub_layered", {"variables": {"N": [0, 0, 1], "I": [0, 0, -1]}}, {"Ci": [[0.25, 1.0, 0.5]]}, [("p2", "pub_co_paint", {"tint": [0, 1, 0.5], "amount": 1, "__category": "layer"}), ("p3", "pub_co_paint", {"tint": [0, 0.5, 0], "amount": 0.5, "__category": "layer"})]),
    ("pub_fundza", {"variables": {"N": [0, 0, 1], "I": [0, 0, -1], "Cs": 0.5}, "lights": [{"file": "sun.sl"}]}, {"Ci": [[0.5, 0.5, 0.5]]}, []),
    ("pub_3delight", {"variables": {"N": [0, 0, 2], "I": [0, 0, -1]}, "lights": [{"file": "sun.sl"}], "parameters": {"i_transparency": [0.5, 0, 0]}}, {"Ci": [[0.2, 0.4, 0.4]], "Oi": [[0.5, 1, 1]], "aov_lum": [0.4]}, []),
    ("pub_brick_idioms", {"variables": {"s": [0, 0.25, 0.75, 1]}}, {"Ci": [[0, 0, 0], [0.5, 0, 0], [1, 0.5, 0], [1, 1, 0]], "count": [3, 3, 4, 4]}, []),
    ("pub_toon", {"variables": {"N": [0, 0, 1], "I": [0, 0, -1]}, "lights": [{"file": "sun.sl"}]}, {"Ci": [[0, 0, 1]]}, []),
    ("pub_metal_base", {}, {"Ci": [[2.0, 1.7, 1.1]]}, []),
    ("pub_triplanar", {"variables": {"N": [0, 0, 1], "P": [[0.3, 0.2, 0], [0.3, 0.8, 0]]}, "parameters": {"pattern": "ch"}}, {"Ci": [[0, 0, 0], [0, 0, 1]]}, [("ch", "pub_co_checks", {})]),
    ("pub_glass", {"variables": {"N": [0, 0, 1], "I": [0, 0, -1]}, "parameters": {"tint": [0.5, 0.5, 0.5]}}, {"Ci": [[0.04, 0.04, 0.04]], "Oi": [[1, 1, 1]]}, []),
    ("pub_getvar", {"variables": {"primvarA": 7}}, {"Ci": [[4.125, 4.125, 3.125]], "Oi": [[1, 7, 0]]}, [("other", "pub_co_other", {})]),
    ("pub_weave", {"variables": {"s": [0.05, 0.15], "t": 0.05}}, {"Ci": [[0.3, 0.3, 0.3], [0.7, 0.7, 0.7]], "result": [0.3, 0.7]}, []),
    ("pub_mattecls", {"variables": {"N": [0, 0, 1], "I": [0, 0, -1]}, "lights": [{"file": "sun.sl"}]}, {"Ci": [[1, 1, 1]]}, []),
    ("pub_vol", {"variables": {"N": [0, 0, 1], "I": [0, 0, -1]}, "lights": [{"file": "sun.sl"}]}, {"Oi": [[0.5, 0.5, 0.5]]}, []),
    ("pub_spline", {"variables": {"s": 0.25}}, {"Ci": [[0.25, 0, 0]], "Oi": [[2, 5, 5]]}, []),
    ("pub_states", {"variables": {"s": [0, 1]}}, {"Ci": [[1, 2, 16], [15, 30, 16]], "Oi": [[1, 1, 1], [1, 1, 1]]}, []),
    ("pub_pts", {}, {"Ci": [[0.3, 0.4, 0.5]], "baked": [0]}, []),
    ("pub_methods", {}, {"Ci": [[8, 10, 4]], "Oi": [[4, 10, 13]]}, []),
    ("pub_sharing", {}, {"Ci": [[220, 3, 5]]}, [("c1", "pub_co_kid", {}), ("c2", "pub_co_kid", {"gain": 7})]),
    ("pub_dispatch", {"parameters": {"a": "one", "b": "two"}, "variables": {"s": [0, 3, 0, 3], "t": [0, 0, 1, 1]}}, {"Ci": [[2, 1, 1], [2, 5, 2], [0, 0, 0], [0, 0, 0]], "Oi": [[0.25, 0.25, 0.25], [0.5, 0.5, 0.5], [0, 0, 0], [0, 0, 0]]}, [("one", "pub_co_one", {}), ("two", "pub_co_two", {})]),
    ("pub_sixlayers", {"variables": {"P": [[0.75, 0.5, 0]]}}, {"Ci": [[110.5, 1.0, 0.5]], "Oi": [[1, 1, 1]]}, []),
    ("pub_light_point", {"variables": {"P": [[0, 0, 2]]}, "parameters": {"intensity": 8}}, {"Cl": [[2, 2, 2]], "L": [[0, 0, 2]]}, []),
    ("pub_spot_old", {"variables": {"P": [[0, 0, 2]]}, "parameters": {"intensity": 8}}, {"Cl": [[2, 2, 2]]}, []),
    ("pub_imager", {"variables": {"N": [0, 0, 1], "s": [1, 2]}, "parameters": {"heights": ["h1", "h2"]}}, {"P": [[0, 0, 1.5], [0, 0, 3.0]]}, [("h1", "pub_co_h", {}), ("h2", "pub_co_h", {"amt": 1})]),
    ("pub_phase", {"variables": {"s": 0.5, "t": 0.25}, "parameters": {"exposure": 1}}, {"Ci": [[1.5, 1.0, 2.5]]}, []),
    ("pub_names", {}, {"Ci": [[78, 6, 2]], "Oi": [[0.5, 0.5, 0.5]]}, []),
    ("pub_strings", {}, {"Ci": [[1, 1, 12]], "Oi": [[13, 3, 1]]}, []),
    ("pub_matrix", {"variables": {"P": [[1, 2, 3]]}}, {"Ci": [[-2, 1, 3]], "Oi": [[1, 2, 1]]}, []),
    ("pub_begin_return", {"variables": {"s": [0, 1, 3]}}, {"Ci": [[100, 100, 100], [12, 12, 12], [0, 0, 0]]}, []),
    ("pub_begin_return", {"variables": {"s": [0.75]}, "parameters": {"mode": 1}}, {"Ci": [[100, 100, 100]]}, []),
    ("pub_use_old", {"variables": {"s": 3}, "parameters": {"colorInput": "pn"}}, {"Ci": [[0.5, 0.75, 3.25]]}, [("pn", "pub_co_old", {})]),
    ("pub_surface_calls", {"variables": {"N": [0, 0, 1], "I": [0, 0, -1]}, "lights": [{"file": "sun.sl"}], "parameters": {"a": "ra", "b": "mb"}}, {"Ci": [[0.5, 0, 1]], "Oi": [[0.75, 0.75, 0.75]]}, [("ra", "pub_co_red", {}), ("mb", "pub_co_mat", {})]),
    ("pub_wildargs", {"variables": {"s": 2}}, {"Ci": [[6, 6, 6]], "Oi": [[0, 1, 6]]}, []),
    ("pub_sh", {}, {"Ci": [[6.283186, 6.283186, 6.283186]]}, []),
    ("pub_bench_like", {"variables": {"s": [0, 0.4, 0.7]}}, {"Ci": [[0, 0, 1], [0, 1, 0], [1, 0, 0]], "Oi": [[0, 9, 1], [0, 9, 1], [0, 9, 1]]}, []),
]


class PublicClasses(Points):
    def test_each_gives_its_numbers(self):
        folder = SOURCE / "tests/rsl/classes"
        for name, document, want, co_shaders in CASES:
            with self.subTest(name):
                files = {one: (folder / f"{one}.sl").read_text() for _, one, _ in co_shaders}
                listed = [{"handle": handle, "file": f"{one}.sl", "parameters": parameters}
                          for handle, one, parameters in co_shaders]
                document = document | ({"coshaders": listed} if listed else {})
                self.check((folder / f"{name}.sl").read_text(), document, want, sun=SUN, **files)


if __name__ == "__main__":
    main()
