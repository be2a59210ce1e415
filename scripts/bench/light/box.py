"""The box of light_against_cycles: a lamp in its ceiling, a block, three bounces."""
SIZE, BOUNCES, WATTS, FIRST_ROW = (96, 96), 3, 12.0, 0
WHITE, RED, GREEN = (0.73, 0.73, 0.73), (0.65, 0.05, 0.05), (0.12, 0.45, 0.15)


def block():
    """Five sides of a cube of half-width .3, turned, as quadrilaterals."""
    from math import cos, radians, sin
    c, s = cos(radians(20)), sin(radians(20))

    def place(x, y, z):
        return (0.3 + c * x + s * z, -0.7 + y, 3.9 - s * x + c * z)

    h = 0.3
    sides = [[(-h, -h, -h), (h, -h, -h), (h, h, -h), (-h, h, -h)],
             [(-h, -h, h), (h, -h, h), (h, h, h), (-h, h, h)],
             [(-h, -h, -h), (-h, -h, h), (-h, h, h), (-h, h, -h)],
             [(h, -h, -h), (h, -h, h), (h, h, h), (h, h, -h)],
             [(-h, h, -h), (h, h, -h), (h, h, h), (-h, h, h)]]
    return [[place(*p) for p in side] for side in sides]


# Quadrilaterals in a space that looks along +z, y up.
WALLS = [(WHITE, [(-1, -1, 3), (1, -1, 3), (1, -1, 5), (-1, -1, 5)]),
         (WHITE, [(-1, 1, 3), (-1, 1, 5), (1, 1, 5), (1, 1, 3)]),
         (WHITE, [(-1, -1, 5), (-1, 1, 5), (1, 1, 5), (1, -1, 5)]),
         (RED, [(-1, -1, 3), (-1, -1, 5), (-1, 1, 5), (-1, 1, 3)]),
         (GREEN, [(1, -1, 3), (1, 1, 3), (1, 1, 5), (1, -1, 5)])] + [(WHITE, q) for q in block()]
# What area lamps of Cycles send of so many watts: a factor of PI / 4 less than these over PI and the area.
SENT = WATTS / 4
LAMP = [(-0.3, 0.99, 3.7), (0.3, 0.99, 3.7), (0.3, 0.99, 4.3), (-0.3, 0.99, 4.3)]

CYCLES = """
walls, lamp, watts = task
def place(p): return (p[0], p[2], p[1])
def mesh(corners, material):
    data = bpy.data.meshes.new("quad")
    data.from_pydata([place(p) for p in corners], [], [(0, 1, 2, 3)])
    data.materials.append(material)
    scene.collection.objects.link(bpy.data.objects.new("quad", data))
def material(color):
    made = bpy.data.materials.new("wall")
    made.use_nodes = True
    nodes = made.node_tree.nodes
    nodes.clear()
    shader, out = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    shader.inputs["Color"].default_value = (*color, 1)
    made.node_tree.links.new(shader.outputs[0], out.inputs["Surface"])
    return made
for color, corners in walls: mesh(corners, material(color))
xs, ys, zs = zip(*lamp)
light = bpy.data.lights.new("lamp", "AREA")
light.shape, light.size, light.size_y = "RECTANGLE", max(xs) - min(xs), max(zs) - min(zs)
light.energy = watts
lamp_object = bpy.data.objects.new("lamp", light)
lamp_object.location = place((sum(xs) / 4, ys[0], sum(zs) / 4))
scene.collection.objects.link(lamp_object)
camera = bpy.data.objects.new("eye", bpy.data.cameras.new("eye"))
camera.rotation_euler = (1.5707963, 0, 0)
camera.data.angle = 0.62831853
scene.collection.objects.link(camera)
scene.camera = camera
"""
TASK = [WALLS, LAMP, WATTS]

PANEL = """light panel(float radiance = 1; float area = 1;) {
    illuminate(P) Cl = radiance * area / PI * max(0, -ycomp(normalize(L))) / (L . L);
}
"""
WALL = """surface wall() {
    normal n = faceforward(normalize(N), I);
    Oi = 1;
    Ci = Cs * (diffuse(n) + indirectdiffuse(P, n, 1));
}
"""


def numbers(values):
    return " ".join(f"{x:.6g}" for x in values)


def polygon(corners):
    return f'Polygon "P" [{numbers(x for p in corners for x in p)}]\n'


def rib(folder, surface):
    """The box for kinora-render; a lamp that sends so much over its area."""
    area = 0.36
    text = f"""Format {SIZE[0]} {SIZE[1]} 1
PixelFilter "box" 1 1
Quantize "rgba" 0 0 0 0
Projection "perspective" "fov" [36]
WorldBegin
Attribute "light" "shadows" "on"
AttributeBegin
Attribute "visibility" "int camera" [0]
Surface "matte" "Kd" 0 "Ka" 0
AreaLightSource "panel" 1 "radiance" [{SENT / area}] "area" [{area}]
{polygon(LAMP)}AttributeEnd
Illuminate 1 1
Sides 2
Surface "{surface}"
"""
    for color, corners in WALLS:
        text += f"Color [{numbers(color)}]\n{polygon(corners)}"
    (folder / "panel.sl").write_text(PANEL)
    (folder / "wall.sl").write_text(WALL)
    path = folder / f"{surface}.rib"
    path.write_text(text + "WorldEnd\n")
    return path


def ours(folder):
    """Scenes and options for kinora-render, by name."""
    return {"indirectdiffuse": (rib(folder, "wall"), ["--bounces", str(BOUNCES)]),
            "--gi": (rib(folder, "matte"), ["--gi", str(BOUNCES)])}
