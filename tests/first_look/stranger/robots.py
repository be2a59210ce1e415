"""In the manner of ROS, URDF, Gazebo, OpenRAVE and CAD: parts of robots and machines."""
import shapes
from .writer import *  # noqa: F403


@document("ros/fetch/meshes/torso_lift.dae")
def stl_in_blender(folder):
    """An STL in millimetres, imported into Blender 2.69, scaled in its node, exported with empty libraries."""
    m = shapes.robot_arm().named("grey")
    return collada(
        asset("Blender 2.69.0 commit date:2013-10-31", comments="")
        + "<library_images/>\n",
        [("effects", effect("grey", phong((0.64, 0.64, 0.64), specular=(0.5, 0.5, 0.5), shininess=50) + "<index_of_refraction><float>1</float></index_of_refraction>")),
         ("materials", material("grey")),
         ("geometries", mesh("torso-mesh", m, scaled(z_up, 1000), kind="polylist", uv=False)),
         ("controllers", "")],
        place_node("torso", "torso-mesh", bind(["grey"]), "<matrix sid=\"transform\">0.001 0 0 0 0 0.001 0 0 0 0 0.001 0 0 0 0 1</matrix>"),
        scene="Scene")


@document("ros/youbot/meshes/arm.dae")
def max_inches(folder):
    """Max to inches with a bump technique; the picture lies in ../materials/textures."""
    paint(folder.parent / "materials/textures", "youbot_arm.png", "steel")
    m = shapes.arm_link(0.5, 0.08).named("armor")
    bump = ('<extra><technique profile="OpenCOLLADA3dsMax"><bump bumptype="HEIGHTFIELD"><texture texture="tex-sampler" texcoord="CHANNEL1"/></bump>'
            '</technique></extra>')
    return collada(
        asset("OpenCOLLADA for 3ds Max; Version: 1.4.1; Revision: 68", "inch", 0.0254),
        [("images", image("tex", "../materials/textures/youbot_arm.png")),
         ("effects", effect("armor", col("emission", 0, 0, 0) + col("ambient", 0.588, 0.588, 0.588) + tex("diffuse", "tex", "CHANNEL1") + col("specular", 0.9, 0.9, 0.9) + num("shininess", 10) + col("reflective", 0, 0, 0) + '<transparent opaque="A_ONE"><color>1 1 1 1</color></transparent>' + num("transparency", 1), "blinn", sampler("tex"), bump)),
         ("materials", material("armor")),
         ("geometries", mesh("geom-arm", m, scaled(z_up, 39.37), texset=' set="1"'))],
        place_node("node-arm", "geom-arm", bind(["armor"], channel="CHANNEL1", input_set=1), "<translate>0 0 3</translate><rotate>0 0 1 -90</rotate>"))


@document("ros/turtlebot/kinect.dae")
def default_blender_scene(folder):
    """The model is 28 cm wide; Blender's own cube, camera and lamp of the default scene were exported with it, the cube deleted."""
    m = shapes.block(0, 0, 0.02, 0.28, 0.07, 0.04, "metal").join(shapes.block(0, 0, -0.02, 0.08, 0.06, 0.04, "rubber"))
    fx, mats = painted(m.materials())
    lamp = ('<light id="Lamp-light" name="Lamp"><technique_common><point><color sid="color">1 1 1</color><constant_attenuation>1</constant_attenuation>'
            "<linear_attenuation>0</linear_attenuation><quadratic_attenuation>0.00111109</quadratic_attenuation></point></technique_common>"
            '<extra><technique profile="blender"><energy sid="blender_energy">1</energy><dist>29.99998</dist></technique></extra></light>')
    camera = ('<camera id="Camera-camera" name="Camera"><optics><technique_common><perspective><xfov sid="xfov">49.13434</xfov>'
              "<aspect_ratio>1.777778</aspect_ratio><znear>0.1</znear><zfar>100</zfar></perspective></technique_common></optics></camera>")
    return collada(
        asset("Blender 2.60.0 r41226"),
        [("cameras", camera), ("lights", lamp), ("effects", fx), ("materials", mats),
         ("geometries", mesh("kinect", m, kind="polylist", uv=False))],
        '<node id="Camera" type="NODE"><matrix sid="transform">0.6858805 -0.3173701 0.6548619 7.481132 0.7276338 0.3124686 -0.6106656 -6.50764 -0.01081678 0.8953432 0.4452454 5.343665 0 0 0 1</matrix><instance_camera url="#Camera-camera"/></node>'
        '<node id="Lamp" type="NODE"><matrix sid="transform">-0.2908646 -0.7711008 0.5663932 4.076245 0.9551712 -0.1998834 0.2183912 1.005454 -0.05518906 0.6045247 0.7946723 5.903862 0 0 0 1</matrix><instance_light url="#Lamp-light"/></node>'
        + place_node("kinect-node", "kinect", bind(m.materials())), scene="Scene")


@document("ros/model_uri/meshes/crate.dae")
def model_uri(folder):
    """Gazebo's model:// in init_from; the picture lies where Gazebo would find it."""
    paint(folder.parent / "materials/textures", "crate_side.png", "planks")
    m = shapes.crate().named("side")
    return collada(
        asset("Blender User"),
        [("images", image("crate_side_png", "model://model_uri/materials/textures/crate_side.png")),
         ("effects", effect("side", tex("diffuse", "crate_side_png"), "lambert", sampler("crate_side_png"))),
         ("materials", material("side")), ("geometries", mesh("crate", m))],
        place_node("crate-node", "crate", bind(["side"], channel="UVMap")))


@document("ros/package_uri/meshes/base.dae")
def package_uri(folder):
    """ROS's package:// in init_from."""
    paint(folder.parent / "materials/textures", "base_color.png", "livery")
    m = shapes.rover().named("body")
    return collada(
        asset("Blender 2.79.0"),
        [("images", image("base_png", "package://my_robot/materials/textures/base_color.png")),
         ("effects", effect("body", tex("diffuse", "base_png"), "lambert", sampler("base_png"))),
         ("materials", material("body")), ("geometries", mesh("base", m))],
        place_node("base-node", "base", bind(["body"], channel="UVMap")))


@document("openrave/barrett.dae")
def kinematics(folder):
    """OpenRAVE: COLLADA 1.5 with kinematics and an articulated system, the visual scene below one node."""
    upper, fore = shapes.arm_link(0.4, 0.06).named("mat0"), shapes.arm_link(0.3, 0.05).named("mat1")
    fx = effect("mat0", col("ambient", 0.2, 0.2, 0.3) + col("diffuse", 0.6, 0.62, 0.7)) + effect("mat1", col("ambient", 0.3, 0.2, 0.1) + col("diffuse", 0.8, 0.5, 0.2))
    nodes = ('<node id="visual1" name="barrett"><node id="v1.node0" sid="node0" name="link0">'
             f'<instance_geometry url="#g0">{bind(["mat0"])}</instance_geometry>'
             '<node id="v1.node1" sid="node1" name="link1"><rotate sid="node_joint0_axis0">0 0 1 0</rotate><translate>0.4 0 0</translate><rotate>0 1 0 -35</rotate>'
             f'<instance_geometry url="#g1">{bind(["mat1"])}</instance_geometry></node></node></node>')
    joints = ('<joint id="joint0" name="J1" sid="joint0"><revolute sid="axis0"><axis>0 0 1</axis><limits><min>-160</min><max>160</max></limits></revolute></joint>')
    model = ('<kinematics_model id="kmodel1" name="barrett"><technique_common><instance_joint url="#joint0" sid="joint0"/>'
             '<link sid="link0" name="link0"><attachment_full joint="kmodel1/joint0"><translate>0.4 0 0</translate><link sid="link1" name="link1"/></attachment_full></link>'
             "</technique_common></kinematics_model>")
    kscene = ('<kinematics_scene id="kscene" name="kscene"><instance_articulated_system url="#robot1_motion" sid="inst"/></kinematics_scene>')
    systems = ('<articulated_system id="robot1_motion"><motion><instance_articulated_system url="#robot1_kin" sid="k"/><technique_common/></motion></articulated_system>'
               '<articulated_system id="robot1_kin"><kinematics><instance_kinematics_model url="#kmodel1" sid="m"/></kinematics></articulated_system>')
    return collada(
        asset("OpenRAVE", up="Z_UP"),
        [("articulated_systems", systems), ("kinematics_scenes", kscene), ("effects", fx), ("materials", material("mat0") + material("mat1")),
         ("geometries", mesh("g0", upper, uv=False, normals="none") + mesh("g1", fore, uv=False, normals="none")),
         ("kinematics_models", model), ("joints", joints)],
        nodes, version="1.5.0", scene="vscene", tail='<instance_kinematics_scene url="#kscene"/>')


@document("rhino/gripper.dae")
def rhino(folder):
    """Rhino: A_ONE with transparency 1, millimetres, no name of a scene's nodes, ambient white."""
    m = shapes.gear().named("Default")
    return collada(
        asset("Rhinoceros 5", "millimeter", 0.001),
        [("effects", effect("Default", col("ambient", 1, 1, 1) + col("diffuse", 0.75, 0.75, 0.75) + col("specular", 1, 1, 1) + num("shininess", 0) + '<transparent opaque="A_ONE"><color>1 1 1 1</color></transparent>' + num("transparency", 1))),
         ("materials", material("Default")), ("geometries", mesh("obj0", m, scaled(z_up, 1000), uv=False, normals="vertices"))],
        f'<node><instance_geometry url="#obj0">{bind(["Default"])}</instance_geometry></node>')


@document("meshlab/scan.dae")
def vcglib(folder):
    """VCGLib: no unit's name, colours and normals of vertices as inputs of triangles without a material."""
    m = lumps()
    return collada(
        asset("VCGLib | MeshLab", None, up="Y_UP"),
        [("images", ""), ("materials", ""), ("effects", ""),
         ("geometries", mesh("shape0-lib", m, y_up, normals="smooth", uv=False, symbol=None, colours=lambda p: (0.5 + 0.4 * p[0], 0.5 + 0.4 * p[1], 0.3, 1)))],
        '<node id="node" name="node"><instance_geometry url="#shape0-lib"/></node>')


@document("assimp/converted.dae")
def assimp(folder):
    """Assimp's writer: $ names, phong of every component, a light of its own defaults is not written."""
    m = shapes.plane()
    names = m.materials()
    fx = "".join(effect(f"m{i}mat", col("emission", 0, 0, 0) + col("ambient", 0, 0, 0) + col("diffuse", *TINTS[n]) + col("specular", 0.25, 0.25, 0.25) + num("shininess", 96) + num("transparency", 0.0 if i else 1.0)) for i, n in enumerate(names))
    to = {n: f"m{i}mat" for i, n in enumerate(names)}
    return collada(
        asset("Assimp Exporter"),
        [("effects", fx), ("materials", "".join(material(to[n]) for n in names)),
         ("geometries", mesh("meshId0", m.named(to), symbol=lambda s: "defaultMaterial" if s == "m0mat" else s))],
        '<node id="$ColladaAutoName$_0" name="$ColladaAutoName$_0"><matrix sid="matrix">1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>'
        f'<instance_geometry url="#meshId0">{bind(to.values(), lambda s: "defaultMaterial" if s == "m0mat" else s)}</instance_geometry></node>')


@document("ros/spaces/meshes/my robot.dae")
def spaces(folder):
    """Percent escapes, another case, and a name with a plus and a umlaut."""
    paint(folder, "Tex Folder/Größe+1.PNG", "fabric")
    m = shapes.sofa().named("cloth")
    return collada(
        asset("Blender 2.74"),
        [("images", image("a", "Tex%20Folder/Gr%C3%B6%C3%9Fe+1.png")), ("effects", effect("cloth", tex("diffuse", "a"), "lambert", sampler("a"))),
         ("materials", material("cloth")), ("geometries", mesh("sofa", m))],
        place_node("sofa node", "sofa", bind(["cloth"], channel="UVMap")))


@document("freecad/bracket.dae")
def freecad(folder):
    """FreeCAD's importDAE: pycollada, unit of a millimetre, one material of ambient and diffuse."""
    m = shapes.bolt().named("mat")
    return collada(
        asset("FreeCAD 0.18", "meter", 0.001),
        [("effects", effect("mat", col("ambient", 0, 0, 0) + col("diffuse", 0.8, 0.8, 0.8) + col("emission", 0, 0, 0) + col("reflective", 0, 0, 0) + num("reflectivity", 0) + num("shininess", 0) + col("specular", 1, 1, 1) + '<transparent opaque="A_ONE"><color>1 1 1 1</color></transparent>' + num("transparency", 1))),
         ("materials", material("mat")), ("geometries", mesh("geometry0", m, scaled(z_up, 1000), uv=False))],
        place_node("node0", "geometry0", bind(["mat"])), scene="myscene")


@document("ros/nested/meshes/wheel.dae")
def nested_asset(folder):
    """The document is in metres with Y up; the geometry's own asset says millimetres and Z up."""
    m = shapes.barrel().named("rubber")
    inner = mesh("wheel", m, scaled(z_up, 1000), uv=False).replace('name="wheel"><mesh>', 'name="wheel">' + asset("CAD", "millimeter", 0.001) + "<mesh>")
    fx, mats = painted(["rubber"])
    return collada(asset("Merge Tool", up="Y_UP"), [("effects", fx), ("materials", mats), ("geometries", inner)], place_node("n", "wheel", bind(["rubber"])))


@document("ros/mirrored/meshes/right_foot.dae")
def mirrored(folder):
    """The left foot's mesh under a mirror and a mirror of the mirror, both in nodes."""
    m = shapes.dog()
    fx, mats = painted(m.materials(), lambert, "lambert")
    b = bind(m.materials())
    return collada(
        asset("Autodesk Maya"), [("effects", fx), ("materials", mats), ("geometries", mesh("foot", m, normals="smooth"))],
        '<node id="a"><scale>-1 1 1</scale>' + place_node("a1", "foot", b, "<translate>0.5 0 0</translate>") + place_node("a2", "foot", b, "<translate>-0.5 0 0</translate><scale>1 -1 1</scale>") + "</node>")


@document("solidworks/housing.dae")
def no_materials_dark_light(folder):
    """A CAD exporter: colours as effects of constant ambient, one directional light of black."""
    m = shapes.truck()
    fx = "".join(effect(n, col("ambient", *TINTS.get(n, (0.5, 0.5, 0.5))) + col("diffuse", *TINTS.get(n, (0.5, 0.5, 0.5))), "phong") for n in m.materials())
    light = '<light id="l"><technique_common><directional><color>0 0 0</color></directional></technique_common></light>'
    return collada(asset("SimLab", "meter", 1), [("lights", light), ("effects", fx), ("materials", "".join(material(n) for n in m.materials())), ("geometries", mesh("t", m, uv=False))],
                   place_node("t-node", "t", bind(m.materials())) + '<node id="ln"><instance_light url="#l"/></node>')


@document("ros/tiff/meshes/shoulder.dae", missing=True)
def tiff(folder):
    """PR2's textures are .tif files, which lie nowhere here."""
    m = shapes.arm_link(0.3, 0.1).named("skin")
    return collada(asset("Max"), [("images", image("s", "shoulder_yaw_color.tif")), ("effects", effect("skin", tex("diffuse", "s") + col("specular", 0.1, 0.1, 0.1) + num("shininess", 10), "blinn", sampler("s"))), ("materials", material("skin")), ("geometries", mesh("s0", m))],
                   place_node("sn", "s0", bind(["skin"], channel="UVMap")))
