# scripts/assets/add_rsl.py: gives Blender's COLLADA file the effects that Blender cannot write:
# profile_RSL surfaces for its materials, RSL lights, and a channel that animates a parameter.
#
#   add_rsl.py IN.dae SHADERS OUT.dae        SHADERS: the folder of the .sl files to embed
import os
import sys
import xml.etree.ElementTree as ET

from split_concave import split_concave

NS = "http://www.collada.org/2005/11/COLLADASchema"
FPS = 24.0

# effect: (stage, shader, {parameter: the newparam's value}): all that a material or light may set.
EFFECTS = {
    "statue-rsl": ("SURFACE", "statue", {"veining": 0.85, "Ks": 0.3, "scale": 5.0,
                                         "bodycolor": (0.78, 0.74, 0.68),
                                         "cloudcolor": (0.50, 0.49, 0.49)}),
    "planks-rsl": ("SURFACE", "planks", {"Kr": 0.22}),
    "plaster-rsl": ("SURFACE", "plaster", {"surface_color": (0.05, 0.15, 0.155),
                                           "unevenness": 0.12}),
    "gloss-rsl": ("SURFACE", "gloss", {"surface_color": (0.75, 0.07, 0.035),
                                       "sole_height": -1000.0, "roughness": 0.05}),
    "softspot-rsl": ("LIGHT", "softspot", {"intensity": 30.0, "lightcolor": (1, 0.86, 0.68),
                                           "radius": 0.12, "coneangle": 0.54,
                                           "conedeltaangle": 0.3}),
    "skylight-rsl": ("LIGHT", "skylight", {"intensity": 1.0}),
}

# material of the Blender scene: (effect, {parameter: value that overrides the effect's})
MATERIALS = {
    "marble": ("statue-rsl", {}),
    "stone": ("statue-rsl", {"veining": 0.25, "bodycolor": (0.60, 0.52, 0.42),
                             "cloudcolor": (0.50, 0.43, 0.35), "Ks": 0.08, "scale": 2.0}),
    "planks": ("planks-rsl", {}),
    "wall": ("plaster-rsl", {}),
    "trim": ("plaster-rsl", {"surface_color": (0.075, 0.19, 0.19), "unevenness": 0.05}),
    "sneaker": ("gloss-rsl", {"sole_height": 0.026}),
    "headphone": ("gloss-rsl", {"surface_color": (0.72, 0.06, 0.03)}),
    "knot": ("gloss-rsl", {"surface_color": (0.80, 0.36, 0.02)}),
    "brass": ("gloss-rsl", {"surface_color": (0.48, 0.32, 0.10), "roughness": 0.12}),
}

LIGHTS = {
    "key": ("softspot-rsl", {"intensity": 30.0}),
    "rim": ("softspot-rsl", {"intensity": 11.0, "lightcolor": (0.55, 0.75, 1.0), "radius": 0.08}),
    "sky": ("skylight-rsl", {"intensity": 1.2}),
}

# The knot slowly changes its color: (target, [(frame, value)]).
ANIMATED = ("knot-material/surface_color", [(1, (0.80, 0.36, 0.02)), (25, (0.75, 0.12, 0.06)),
                                            (49, (0.45, 0.05, 0.30)), (72, (0.06, 0.20, 0.60))])


def tag(name):
    return f"{{{NS}}}{name}"


def add(parent, element_name, text=None, /, **attributes):
    element = ET.SubElement(parent, tag(element_name), attributes)
    element.text = text
    return element


def add_value(parent, value):
    if isinstance(value, tuple):
        add(parent, "color", " ".join(f"{v:g}" for v in value))
    else:
        add(parent, "float", f"{value:g}")


def code_marker(shader):
    return f"@code:{shader}@"


def add_effect(library, effect, fallback):
    """profile_COMMON, for viewers without RSL, is one that Blender wrote."""
    stage, shader, defaults = EFFECTS[effect]
    element = add(library, "effect", id=effect)
    for name, value in defaults.items():
        add_value(add(element, "newparam", sid=name), value)
    if fallback is not None:
        element.append(fallback)
    profile = add(element, "profile_RSL")
    technique = add(profile, "technique", sid="default")
    add(technique, "code", code_marker(shader))
    entry = add(add(technique, "pass"), "shader", stage=stage)
    add(entry, "name", shader)
    for name in defaults:
        add(add(entry, "bind", symbol=name), "param", ref=name)


def set_instance(parent, effect, values):
    instance = add(parent, "instance_effect", url="#" + effect)
    for name, value in values.items():
        add_value(add(instance, "setparam", ref=name), value)


def replace_effects(root):
    library = root.find(tag("library_effects"))
    blender = {e.get("id"): e for e in library}
    for element in list(library):
        library.remove(element)
    for effect in EFFECTS:
        users = [name for name, (used, _) in MATERIALS.items() if used == effect]
        fallback = blender[users[0] + "-effect"].find(tag("profile_COMMON")) if users else None
        add_effect(library, effect, fallback)
    for material in root.find(tag("library_materials")):
        name = material.get("id").removesuffix("-material")
        for element in list(material):
            material.remove(element)
        set_instance(material, *MATERIALS[name])


def replace_lights(root):
    for light in root.find(tag("library_lights")):
        for extra in light.findall(tag("extra")):
            light.remove(extra)
        technique = add(add(light, "extra"), "technique", profile="RSL")
        set_instance(technique, *LIGHTS[light.get("name")])


def add_source(animation, name, numbers, stride, params, kind="float"):
    source = add(animation, "source", id=name)
    array = {"float": "float_array", "name": "Name_array"}[kind]
    add(source, array, " ".join(numbers), id=name + "-array", count=str(len(numbers)))
    accessor = add(add(source, "technique_common"), "accessor", source=f"#{name}-array",
                   count=str(len(numbers) // stride), stride=str(stride))
    for param in params:
        add(accessor, "param", name=param, type=kind)
    return "#" + name


def add_channel(root, target, keys):
    name = target.replace("/", "-")
    animation = add(root.find(tag("library_animations")), "animation", id=name)
    times = add_source(animation, name + "-input", [f"{f / FPS:.6f}" for f, _ in keys], 1, ["TIME"])
    values = add_source(animation, name + "-output", [f"{v:g}" for _, c in keys for v in c], 3,
                        ["R", "G", "B"])
    kinds = add_source(animation, name + "-interpolation", ["LINEAR"] * len(keys), 1,
                       ["INTERPOLATION"], "name")
    sampler = add(animation, "sampler", id=name + "-sampler")
    for semantic, source in (("INPUT", times), ("OUTPUT", values), ("INTERPOLATION", kinds)):
        add(sampler, "input", semantic=semantic, source=source)
    add(animation, "channel", source=f"#{name}-sampler", target=target)


def embed_code(text, shaders):
    for _, shader, _ in EFFECTS.values():
        with open(os.path.join(shaders, shader + ".sl")) as file:
            text = text.replace(code_marker(shader), f"<![CDATA[\n{file.read()}]]>")
    return text


def main(source, shaders, target):
    ET.register_namespace("", NS)
    tree = ET.parse(source)
    root = tree.getroot()
    replace_effects(root)
    replace_lights(root)
    set_values = MATERIALS["knot"][1]
    assert ANIMATED[0].split("/")[1] in set_values  # a channel needs a setparam to write
    add_channel(root, *ANIMATED)
    for stamp in ("created", "modified"):  # the same scene is the same file
        root.find(f"{tag('asset')}/{tag(stamp)}").text = "2026-11-21T00:00:00Z"
    for library in [e for e in root if "library_" in e.tag and len(e) == 0]:
        root.remove(library)  # the schema wants an item in each
    ET.indent(tree, " ")
    text = ET.tostring(root, encoding="unicode")
    with open(target, "w") as file:
        file.write('<?xml version="1.0" encoding="utf-8"?>\n' + split_concave(embed_code(text, shaders)) + "\n")


main(*sys.argv[1:])
