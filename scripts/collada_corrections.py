"""scripts/collada_corrections.py: what scripts/collada_table adds to the facts of the schemas: names
of types that the versions share, profile_RSL, mistakes of the schemas, what Kinora makes of each."""
import re

# A type's name (of one version, or of any) -> its name in the table.
TYPE_NAMES = {
    ("V14", "common_color_or_texture"): "fx_common_color_or_texture",
    ("V14", "common_float_or_param"): "fx_common_float_or_param",
    ("V14", "common_transparent"): "fx_common_transparent",
    ("V14", "common_newparam"): "fx_common_newparam",
    "fx_code_profile": "fx_code",
    "fx_surface_face": "image_face",
    "gles_texcombiner_argumentRGB": "gles_texcombiner_argument_rgb",
    "gles_texcombiner_commandRGB": "gles_texcombiner_command_rgb",
    "gles_texcombiner_operandRGB": "gles_texcombiner_operand_rgb",
    "gles_texcombiner_operatorRGB": "gles_texcombiner_operator_rgb",
    "gles_texcombiner_operandAlpha": "gles_texcombiner_operand_alpha",
    "gles_texcombiner_operatorAlpha": "gles_texcombiner_operator_alpha",
    "GL_MAX_LIGHTS": "gl_max_lights", "GL_MAX_CLIP_PLANES": "gl_max_clip_planes",
    "GLES_MAX_LIGHTS": "gles_max_lights", "GLES_MAX_CLIP_PLANES": "gles_max_clip_planes",
    "GLES_MAX_TEXTURE_COORDS": "gles_max_texture_coords",
    "GLES_MAX_TEXTURE_IMAGE_UNITS": "gles_max_texture_image_units",
    "profile": "profile_COMMON", "profile_cg": "profile_CG", "profile_glsl": "profile_GLSL",
    "profile_gles": "profile_GLES", "profile_gles2": "profile_GLES2",
    "profile_bridge": "profile_BRIDGE",
    "idref_array": "IDREF_array", "name_array": "Name_array", "sidref_array": "SIDREF_array",
    **{f"instance_{kind}": "instance_with_extra"
       for kind in ("camera", "light", "image", "force_field", "physics_material", "joint")},
}

PATTERNS = {"uri_fragment": "fragment", "urifragment": "fragment", "sidref": "sidref",
            "author_email": "email"}

# (type, child) -> a type of the child's own, made as a copy, so that it has a use of its own.
CHILD_TYPES = {
    ("scene", "instance_physics_scene"): "instance_physics_scene",
}

# name, what it holds, types it starts from; earlier chapters take what they reach first, but not
# what another starts from.
CHAPTERS = [
    ("core", "documents, geometry, animation, controllers, scenes", ["COLLADA"]),
    ("effects", "images, materials, effects, profile_COMMON and profile_RSL",
     ["library_images", "library_materials", "library_effects", "effect", "instance_effect", "profile_RSL",
      "profile_COMMON", "fx_newparam", "profile_BRIDGE"]),
    ("cg", "profile_CG", ["profile_CG"]),
    ("glsl", "profile_GLSL", ["profile_GLSL"]),
    ("gles", "profile_GLES and profile_GLES2", ["profile_GLES", "profile_GLES2"]),
    ("physics", "physics",
     ["library_force_fields", "library_physics_materials", "library_physics_models",
      "library_physics_scenes", "ellipsoid"]),
    ("kinematics", "kinematics and formulas",
     ["library_joints", "library_kinematics_models", "library_articulated_systems",
      "library_kinematics_scenes", "library_formulas", "instance_kinematics_scene",
      "instance_formula"]),
    ("brep", "boundary representation", ["brep"]),
]

# What the picture would need and is made without.
UNSUPPORTED = {"lines", "linestrips", "convex_mesh", "spline", "brep", "instance_formula",
               "instance_physics_scene", "instance_kinematics_scene"}
# What is read into the picture; all else is kept.
RENDERED = set("""
COLLADA asset unit up_axis scene instance_with_extra
library_geometries geometry mesh vertices input_local input_local_offset polygons polylist triangles
trifans tristrips p ph source float_array int_array bool_array Name_array IDREF_array SIDREF_array
token_array technique_common_in_source accessor param
library_controllers controller skin joints vertex_weights morph targets
library_animations animation sampler channel library_animation_clips animation_clip
library_cameras camera optics technique_common_in_optics perspective orthographic targetable_float
library_lights light technique_common_in_light ambient directional point spot targetable_float3
constant_attenuation linear_attenuation quadratic_attenuation falloff_angle falloff_exponent
library_images image init_from_in_image library_materials material instance_effect
setparam_in_instance_effect library_effects effect fx_newparam profile_COMMON fx_common_newparam
technique_in_profile_COMMON constant lambert phong blinn fx_common_color_or_texture
fx_common_float_or_param fx_common_transparent color float texture param_ref fx_surface
fx_surface_init_from fx_sampler2D instance_image
profile_RSL technique_in_profile_RSL rsl_newparam rsl_array rsl_pass rsl_shader rsl_bind fx_code
rsl_include
hex_in_image create_2d create_3d create_cube init_from_in_create_2d init_from_in_create_3d
init_from_in_create_cube wrap_s_in_fx_sampler1D wrap_s_in_fx_sampler_states wrap_t_in_fx_sampler2D
wrap_t_in_fx_sampler_states minfilter magfilter mipfilter_in_fx_sampler1D
mipfilter_in_fx_sampler_states
library_nodes library_visual_scenes visual_scene evaluate_scene render node lookat matrix rotate scale skew translate
instance_controller instance_geometry instance_node bind_material technique_common_in_bind_material
instance_material bind_in_instance_material bind_vertex_input
""".split())


def use(name):
    if name in UNSUPPORTED:
        return "Unsupported"
    return "Rendered" if name in RENDERED else "Kept"


# Values of shader parameters: what every profile has, and what RSL has besides.
RSL_PLAIN = ("(bool=boolean | int=long | float=double | float2=double[2] | float3=double[3] | "
             "float4=double[4] | float4x4=double[16] | string=string | @rsl_value)")
RSL_VALUES = ("(point=double[3] | vector=double[3] | normal=double[3] | color=double[] | "
              "matrix=double[16] | array:rsl_array)")

# profile_RSL: docs/format.md. Appendix A writes a stray <br/> before <bind>.
RSL = {
    "profile_RSL": ("id:ID platform:NCName",
                    "asset? (image | newparam:rsl_newparam)* technique:technique_in_profile_RSL+ extra*", ""),
    "technique_in_profile_RSL": (
        "id:ID !sid:NCName",
        "asset? annotate:fx_annotate* (code:fx_code | include:rsl_include | newparam:rsl_newparam)* "
        "pass:rsl_pass+ extra*", ""),
    "rsl_include": ("sid:NCName !url:anyURI", "", ""),
    "rsl_newparam": ("!sid:NCName",
                     "annotate:fx_annotate* semantic=NCName? modifier=fx_modifier? "
                     "@rsl_plain", ""),
    "rsl_array": ("length:positiveInteger", "@rsl_plain*", ""),
    "rsl_pass": ("sid:NCName", "annotate:fx_annotate* shader:rsl_shader+ extra*", ""),
    "rsl_shader": ("!stage:rsl_stage handle:NCName",
                   "annotate:fx_annotate* name=string? br=%anything? (bind:rsl_bind br=%anything?)* extra*", ""),
    "rsl_bind": ("!symbol:token", "(param:param_ref | @rsl_plain)", ""),
}
RSL_STAGES = "SURFACE DISPLACEMENT LIGHT VOLUME TRANSFORMATION IMAGER COSHADER"


def correct(rows, Row, Group):
    share_spelling(rows, Row)
    copy = rows["instance_with_extra", "V14"]
    rows["instance_physics_scene", "V14"] = rows["instance_physics_scene", "V15"] = copy
    for version in ("V14", "V15"):
        for name, words in RSL.items():
            rows[name, version] = Row(*words)
        rows["@rsl_plain", version] = Group(RSL_PLAIN)
        rows["@rsl_value", version] = Group(RSL_VALUES)
        effect = rows[{"V14": "effect", "V15": "@fx_profile"}[version], version]
        effect.content = effect.content.replace("(profile_", "(profile_RSL | profile_", 1)
    # The effect's own parameters, and a material's, may be of RSL's types.
    for name in ("fx_newparam", "setparam_in_instance_effect"):
        for version in ("V14", "V15"):
            row = rows[name, version]
            row.content = re.sub(r"(@fx_(basic|newparam|setparam))",
                                 r"(\1 | @rsl_value | string=string)", row.content)
    param_refs(rows, Row)


def share_spelling(rows, Row):
    """1.4 declares at each place what 1.5 gives a type; names are NCName in 1.4 and token in 1.5."""
    for name in ("p", "scale", "translate"):
        rows[name, "V14"] = Row(*rows[name, "V15"].words())
    for (name, version), row in rows.items():
        if version == "V14":
            row.content = row.content.replace("p=unsignedLong[]", "p")
            row.content = re.sub(r"\b(scale|translate):targetable_float3", r"\1", row.content)
        other = rows.get((name, "V15" if version == "V14" else "V14"))
        if other and "name:" in row.attributes and "name:" in other.attributes:
            kinds = {re.search(r"name:(\w+)", r.attributes)[1] for r in (row, other)}
            if kinds == {"NCName", "token"}:
                for r in (row, other):
                    r.attributes = re.sub(r"name:\w+", "name:label", r.attributes)


def param_refs(rows, Row):
    """<param ref> in its many places is one type."""
    same = Row("!ref:NCName", "", "")
    gone = {name for (name, _), row in rows.items()
            if name.startswith("param_in_") and row.words() == same.words()}
    for key in [k for k in rows if k[0] in gone]:
        del rows[key]
    for row in rows.values():
        row.content = re.sub(r":(param_in_\w+)", lambda m: ":param_ref" if m[1] in gone else m[0],
                             row.content)
    rows["param_ref", "V14"] = rows["param_ref", "V15"] = same


def correct_simple(simple_rows):
    simple_rows["label", "V14"] = ("NCName", "")
    simple_rows["label", "V15"] = ("token", "")
    for version in ("V14", "V15"):
        simple_rows["rsl_stage", version] = ("NMTOKEN", RSL_STAGES)
