"""tests/programs/convert/animated_parameters_test.py: colors, lights, optics and RSL parameters that move stay in
motion from COLLADA to glTF (KHR_animation_pointer) and back; pictures at several times before and after."""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import programs
import written_scenes as scenes
from convert_gltf_test import Gltf, GltfConvert
from convert_test import LIKE, convert, glb_json

TIMES = (0, 0.3, 0.5, 0.8, 1)
LAMP = ('<library_lights><light id="lamp"><technique_common><point><color sid="tint">{}</color>'
        '<constant_attenuation>0</constant_attenuation><linear_attenuation>0</linear_attenuation>'
        '<quadratic_attenuation>0.111</quadratic_attenuation></point></technique_common>{}</light></library_lights>')
LAMP_NODE = '<node id="ln"><translate>0.5 0.5 3</translate><instance_light url="#lamp"/></node>'
GLOW = "surface glow(uniform float k = 1; uniform color tint = 1;) { Ci = k * tint; Oi = 1; }"
BEAM = 'light beam(float power = 1;) { illuminate(point "shader" (0, 0, 0)) Cl = power; }'
BEAM_EFFECT = ('<library_effects><effect id="beam-fx"><newparam sid="power"><float>1</float></newparam>'
               '<profile_COMMON><technique sid="c"><constant/></technique></profile_COMMON>'
               f'<profile_RSL><technique sid="t"><code><![CDATA[{BEAM}]]></code><pass><shader stage="LIGHT">'
               '<name>beam</name><bind symbol="power"><param ref="power"/></bind></shader></pass></technique>'
               '</profile_RSL></effect></library_effects>')


def pointers(glb):
    """The pointers of a file, in order."""
    return [channel["target"]["extensions"]["KHR_animation_pointer"]["pointer"]
            for animation in glb_json(glb).get("animations", []) for channel in animation["channels"]
            if channel["target"]["path"] == "pointer"]


class AnimatedParameters(GltfConvert):
    def pictures(self, scene, *words):
        return [self.picture(scene, "--time", time, *words) for time in TIMES]

    def trip(self, scene, *words):
        """To the other format and back, without a loss; the picture moves, and stays the same. Returns both files."""
        before = self.pictures(scene, *words)
        self.assertGreater(max(self.difference(before[0], b) for b in before), 5)
        endings = (".dae", ".glb") if scene.suffix == ".gltf" else (".glb", ".dae")
        files, at = [], scene
        for k, ending in enumerate(endings):
            result = convert(at, self.folder / f"{scene.stem}-{k}{ending}")
            self.expect(result, 0)
            self.assertNotIn("animated", result.err)
            at = self.folder / f"{scene.stem}-{k}{ending}"
            for time, b, a in zip(TIMES, before, self.pictures(at, *words)):
                self.assertLess(self.difference(b, a), LIKE, f"{at.name} at {time}")
            files.append(at)
        self.valid(*(f for f in files if f.suffix == ".glb"))
        self.expect(programs.run("kinora-validate", "--only", "SCHEMA_,LINK_,RSL_,ANIM_",
                                 *(f for f in files if f.suffix == ".dae")), 0)
        return files

    def dae(self, name, libraries, *animations, nodes=""):
        return self.write(name, scenes.document(
            scenes.CAMERA + scenes.geometries(scenes.square()) + libraries + scenes.animations(*animations),
            scenes.EYE + scenes.place() + nodes))

    def test_a_color_of_a_common_material(self):
        for model, slot in (("constant", "emission"), ("lambert", "diffuse")):
            with self.subTest(slot):
                material = scenes.common(model, slot).replace("<color>", '<color sid="k">')
                scene = self.dae(f"{slot}.dae", material + LAMP.format("1 1 1", ""),
                                 scenes.animation("a", "fx/c/k", [0, 1], [1, 0, 0, 1, 0, 0.2, 1, 1], 4),
                                 nodes=LAMP_NODE)
                glb, _ = self.trip(scene)
                self.assertIn("/materials/0/pbrMetallicRoughness/baseColorFactor", pointers(glb))
                self.assertIn("KHR_animation_pointer", glb_json(glb)["extensionsUsed"])

    def test_one_component_of_a_color(self):
        material = scenes.common("constant", "emission").replace("<color>", '<color sid="k">')
        scene = self.dae("one.dae", material, scenes.animation("a", "fx/c/k.G", [0, 1], [0, 1]))
        glb, _ = self.trip(scene)
        self.assertEqual(len([p for p in pointers(glb) if p.endswith("baseColorFactor")]), 1)

    def test_steps_stay_steps(self):
        material = scenes.common("constant", "emission").replace("<color>", '<color sid="k">')
        scene = self.dae("steps.dae", material, scenes.animation(
            "a", "fx/c/k", [0, 0.5, 1], [1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 1], 4, "STEP"))
        glb, back = self.trip(scene)
        kinds = {s["interpolation"] for a in glb_json(glb)["animations"] for s in a["samplers"]}
        self.assertEqual(kinds, {"STEP"})
        self.assertNotIn("LINEAR", back.read_text())

    def test_the_color_of_a_light(self):
        scene = self.dae("light.dae", scenes.MATTE + LAMP.format("1 1 1", ""),
                         scenes.animation("a", "lamp/tint", [0, 1], [0.1, 0.1, 0.1, 1, 0.5, 0], 3), nodes=LAMP_NODE)
        glb, _ = self.trip(scene)
        lamp = "/extensions/KHR_lights_punctual/lights/0/"
        self.assertEqual(set(pointers(glb)), {lamp + "intensity", lamp + "color"})

    def test_parameters_of_a_surface_in_rsl(self):
        params = ('<newparam sid="k"><float>1</float></newparam><newparam sid="tint"><float3>1 1 1</float3></newparam>')
        binds = ('<name>glow</name><bind symbol="k"><param ref="k"/></bind>'
                 '<bind symbol="tint"><param ref="tint"/></bind>')
        scene = self.dae("rsl.dae", scenes.rsl(GLOW, params, binds),
                         scenes.animation("a", "fx/k", [0, 1], [0.2, 1]),
                         scenes.animation("b", "fx/tint", [0, 1], [1, 0, 0, 0, 0, 1], 3))
        glb, _ = self.trip(scene)
        own = "/materials/0/extras/kinora_rsl/surface/params/"
        self.assertEqual(set(pointers(glb)), {own + "k", own + "tint"})

    def test_a_parameter_of_a_light_in_rsl(self):
        extra = '<extra><technique profile="RSL"><instance_effect url="#beam-fx"/></technique></extra>'
        libraries = scenes.MATTE.replace("<library_effects>", BEAM_EFFECT.replace("</library_effects>", ""))
        scene = self.dae("beam.dae", libraries + LAMP.format("1 1 1", extra),
                         scenes.animation("a", "beam-fx/power", [0, 1], [0.1, 1]), nodes=LAMP_NODE)
        glb, _ = self.trip(scene)
        self.assertEqual(pointers(glb),
                         ["/extensions/KHR_lights_punctual/lights/0/extras/kinora_rsl/light/params/power"])

    def test_the_optics_of_a_camera(self):
        for name, optics, target, member in (
                ("view", "<perspective><yfov sid='v'>30</yfov><znear>0.1</znear><zfar>100</zfar></perspective>",
                 "perspective", "yfov"),
                ("size", "<orthographic><ymag sid='v'>2</ymag><znear>0.1</znear><zfar>100</zfar></orthographic>",
                 "orthographic", "ymag")):
            with self.subTest(name):
                library, eye = scenes.camera(optics)
                low, high = (20, 60) if name == "view" else (1.5, 4)
                scene = self.write(f"{name}.dae", scenes.document(
                    library + scenes.geometries(scenes.square()) + scenes.WHITE +
                    scenes.animations(scenes.animation("a", "cam/v", [0, 1], [low, high])), eye + scenes.place()))
                glb, _ = self.trip(scene)
                self.assertIn(f"/cameras/0/{target}/{member}", pointers(glb))

    def test_clips_stay_clips(self):
        material = scenes.common("constant", "emission").replace("<color>", '<color sid="k">')
        clips = ('<library_animation_clips><animation_clip id="red" start="0" end="1"><instance_animation url="#a"/>'
                 '</animation_clip><animation_clip id="green" start="0" end="1"><instance_animation url="#b"/>'
                 "</animation_clip></library_animation_clips>")
        scene = self.dae("clips.dae", material, scenes.animation("a", "fx/c/k.R", [0, 1], [1, 0]),
                         scenes.animation("b", "fx/c/k.G", [0, 1], [1, 0]))
        scene.write_text(scene.read_text().replace("<library_visual_scenes>", clips + "<library_visual_scenes>"))
        for clip in ("red", "green"):
            self.trip(scene, "--clip", clip)
        self.trip(scene)

    def drive(self, gltf, pointer, kind, numbers):
        """A channel from 0 to 1 second."""
        animation = gltf.tree.setdefault("animations", [{"channels": [], "samplers": []}])[0]
        animation["samplers"].append({"input": gltf.floats("SCALAR", [0, 1], bounds=True),
                                      "output": gltf.floats(kind, numbers)})
        animation["channels"].append({
            "sampler": len(animation["samplers"]) - 1,
            "target": {"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": pointer}}}})
        used = gltf.tree.setdefault("extensionsUsed", [])
        if "KHR_animation_pointer" not in used:
            used.append("KHR_animation_pointer")

    def test_gltfs_materials_become_colladas_in_motion(self):
        unlit = Gltf(extensions={"KHR_materials_unlit": {}})
        self.drive(unlit, "/materials/0/pbrMetallicRoughness/baseColorFactor", "VEC4", [0, 0, 0, 1, 1, 0.5, 0, 1])
        glowing = Gltf(pbrMetallicRoughness={"metallicFactor": 0}, emissiveFactor=[1, 1, 1])
        self.drive(glowing, "/materials/0/emissiveFactor", "VEC3", [0, 0, 0, 1, 0.9, 0.8])
        for name, gltf in (("unlit", unlit), ("glowing", glowing)):
            with self.subTest(name):
                dae, _ = self.trip(self.save(name, gltf))
                self.assertIn('target="', dae.read_text())

    def test_gltfs_lights_become_colladas_in_motion(self):
        gltf = Gltf(pbrMetallicRoughness={"metallicFactor": 0})
        gltf.tree["extensionsUsed"] = ["KHR_lights_punctual"] + gltf.tree.get("extensionsUsed", [])
        gltf.tree["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": 1}]}}
        gltf.tree["nodes"].append({"extensions": {"KHR_lights_punctual": {"light": 0}}})
        gltf.tree["scenes"][0]["nodes"].append(2)
        self.drive(gltf, "/extensions/KHR_lights_punctual/lights/0/intensity", "SCALAR", [0.2, math.pi])
        self.drive(gltf, "/extensions/KHR_lights_punctual/lights/0/color", "VEC3", [1, 1, 1, 1, 0.5, 0.2])
        before = self.pictures(self.save("sun", gltf))
        self.assertGreater(self.difference(before[0], before[-1]), 5)
        dae = self.converted(self.folder / "sun.gltf", "sun.dae")
        again = self.converted(self.folder / "sun.gltf", "sun.glb")
        for time, b, a in zip(TIMES, before, self.pictures(again)):
            self.assertLess(self.difference(b, a), LIKE, time)
        tail = self.converted(dae, "tail.glb")
        for time, b, a in zip(TIMES, self.pictures(dae), self.pictures(tail)):
            self.assertLess(self.difference(b, a), LIKE, time)
        shown = self.pictures(dae)
        self.assertGreater(self.difference(shown[0], shown[-1]), 5)

    def test_what_collada_cannot_say_is_named(self):
        gltf = Gltf(pbrMetallicRoughness={"metallicFactor": 0}, name="brick", alphaMode="MASK")
        self.drive(gltf, "/materials/0/alphaCutoff", "SCALAR", [0, 1])
        result = convert(self.save("cut", gltf), self.folder / "cut.dae")
        self.expect(result, 0, "CONVERT_LOST", "material 'brick': lost: its animated 'alpha_cutoff'")

    def test_a_pointer_that_nothing_follows_is_named(self):
        gltf = Gltf(pbrMetallicRoughness={"metallicFactor": 0})
        self.drive(gltf, "/materials/3/alphaCutoff", "SCALAR", [0, 1])
        result = convert(self.save("far", gltf), self.folder / "far.glb")
        self.expect(result, 0, "GLTF_POINTER", "/materials/3/alphaCutoff")


if __name__ == "__main__":
    programs.main()
