"""tests/programs/references_test.py: lights, cameras and skins of files in other units and axes
are what they are in their own file, whichever way the scene refers to them."""
import math

from programs import main, render
from written_scenes import (CAMERA, EYE, MATTE, WHITE, SceneTest, camera, controllers, document, geometries, mesh,
                            one_joint_skin, place, square)

CM = {"meter": 0.01}
WHOLE = (256, 8, 23, 8, 23)


def lights(quadratic, kind="point"):
    return (f'<library_lights><light id="L"><technique_common><{kind}><color>1 1 1</color><constant_attenuation>1'
            f"</constant_attenuation><linear_attenuation>0</linear_attenuation><quadratic_attenuation>{quadratic}"
            f"</quadratic_attenuation></{kind}></technique_common></light></library_lights>")


def lit(url, where="<translate>0 0 1</translate>", kind="light"):
    return f'<node>{where}<instance_{kind} url="{url}"/></node>'


class Lights(SceneTest):
    # One metre off, 1 / (1 + d^2) in metres: by hand under the pixel beside the middle.
    R2 = 2 * 0.0625 ** 2
    WANTED = 255 / (1 + 1 + R2) / math.sqrt(1 + R2)

    def middle(self, libraries, nodes, **options):
        self.render(document(CAMERA + MATTE + geometries(square()) + libraries, EYE + place() + nodes, **options))
        return self.pixel()[0]

    def test_attenuation_is_in_the_units_of_the_light_s_file(self):
        self.assertAlmostEqual(self.middle(lights(1), lit("#L")), self.WANTED, delta=1.5)
        for kind in ("point", "spot"):
            below = '<library_nodes><node id="lamp"><translate>0 0 100</translate><instance_light url="#L"/></node></library_nodes>'
            self.write("lights.dae", document(lights(1e-4, kind) + below, **CM))
            for nodes in (lit("lights.dae#L"), lit("lights.dae#lamp", "", "node")):
                self.assertAlmostEqual(self.middle("", nodes), self.WANTED, delta=1.5, msg=f"{kind} {nodes}")


class Cameras(SceneTest):
    def test_orthographic_windows_are_in_the_units_of_the_camera_s_file(self):
        cameras, eye = camera(unit=100)
        self.write("cams.dae", document(cameras + f"<library_nodes>{eye}</library_nodes>", **CM))
        rest = WHITE + geometries(square())
        self.render(document(CAMERA + rest, EYE + place()))
        self.assertEqual(self.box(), WHOLE)
        for nodes in ('<node id="mine"><translate>0 0 5</translate><instance_camera url="cams.dae#cam"/></node>',
                      '<node id="mine"><instance_node url="cams.dae#eye"/></node>'):
            self.render(document(rest, nodes + place()))
            self.assertEqual(self.box(), WHOLE, nodes)

    def test_a_camera_is_called_by_the_node_that_refers_to_it(self):
        cameras, _ = camera(unit=100)
        self.write("cams.dae", document(cameras, **CM))
        nodes = '<node id="mine"><translate>0 0 5</translate><instance_camera url="cams.dae#cam"/></node>'
        text = document(CAMERA + WHITE + geometries(square()),
                        EYE.replace("0 0 5", "9 0 5") + nodes + place())
        self.render(text, "--camera", "mine")
        self.assertEqual(self.box(), WHOLE)
        self.expect(render(self.folder / "scene.dae", "--list", "cameras"), 0, "camera mine (cam")

    def test_clip_ranges_are_in_the_units_of_the_camera_s_file(self):
        optics = "<perspective><yfov>45</yfov><aspect_ratio>1</aspect_ratio><znear>{n}</znear><zfar>{f}</zfar></perspective>"
        rest = WHITE + geometries(square())
        here, eye = camera(optics)
        self.render(document(here + rest, eye + place()), out="one.png")
        self.write("cams.dae", document(camera(optics, unit=100)[0], **CM))
        self.render(document(rest, eye.replace("#cam", "cams.dae#cam") + place()))
        self.assertEqual(self.bytes_of("a.png"), self.bytes_of("one.png"))
        self.assertIsNotNone(self.box())


class Skins(SceneTest):
    SHIFT = "1 0 0 {} 0 1 0 0 0 0 1 0 0 0 0 1"
    JOINT = '<node id="root" sid="j" type="JOINT">{}</node>'
    # Half a metre to the right by the bind shape, half a metre up by the joint: 4 pixels each.
    WANTED = (256, 12, 27, 4, 19)

    def skinned(self, url, libraries="", joint="<translate>0 0.5 0</translate>", transforms=""):
        node = place(transforms, url=url, kind="controller", skeleton="<skeleton>#root</skeleton>")
        self.render(document(CAMERA + WHITE + libraries, EYE + self.JOINT.format(joint) + node))
        return self.box()

    def test_a_skin_of_another_unit_moves_with_joints_of_the_scene(self):
        here = geometries(square()) + controllers(one_joint_skin("square", self.SHIFT.format(0.5)))
        self.assertEqual(self.skinned("#skin", here), self.WANTED)
        there = geometries(square(half=100)) + controllers(one_joint_skin("square", self.SHIFT.format(50)))
        self.write("skin.dae", document(WHITE + there, **CM))
        self.assertEqual(self.skinned("skin.dae#skin"), self.WANTED)

    def test_a_skin_of_another_axis_is_turned(self):
        upright = mesh("square", [-1, 0, -1, 1, 0, -1, 1, 0, 1, -1, 0, 1], [0, 1, 2, 0, 2, 3])
        skin = controllers(one_joint_skin("square", self.SHIFT.format(0.5)))
        self.write("skin.dae", document(WHITE + geometries(upright) + skin, up="Z_UP"))
        self.assertEqual(self.skinned("skin.dae#skin"), self.WANTED)

    def test_a_skin_without_bind_shape_at_a_moved_node_stands_there_in_any_unit(self):
        identity = self.SHIFT.format(0)
        at = "<translate>0.5 0 0</translate>"
        here = geometries(square()) + controllers(one_joint_skin("square", identity))
        wanted = self.skinned("#skin", here, "", at)
        there = geometries(square(half=100)) + controllers(one_joint_skin("square", identity))
        self.write("skin.dae", document(WHITE + there, **CM))
        self.assertEqual(self.skinned("skin.dae#skin", "", "", at), wanted)

    def test_a_whole_rig_is_converted_once(self):
        there = geometries(square(half=100)) + controllers(one_joint_skin("square", self.SHIFT.format(50)))
        rig = ('<library_nodes><node id="rig">' + self.JOINT.format("<translate>0 50 0</translate>") +
               place(url="#skin", kind="controller", skeleton="<skeleton>#root</skeleton>") + "</node></library_nodes>")
        self.write("skin.dae", document(WHITE + there + rig, **CM))
        self.render(document(CAMERA, EYE + '<node><instance_node url="skin.dae#rig"/></node>'))
        self.assertEqual(self.box(), self.WANTED)


if __name__ == "__main__":
    main()
