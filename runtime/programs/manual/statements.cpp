// runtime/programs/manual/statements.cpp: the entries.
#include "runtime/programs/manual/statements.h"

namespace kinora {

namespace {

constexpr ManualEntry kStatements[] = {
    {"if else", "if (condition) statement [else statement]",
     "Runs one of the statements. A condition is a comparison, or a float that is true where it is "
     "not 0. Each point decides for itself. PRMan's if \"any\" (...) and if \"all\" (...) ask "
     "about a "
     "grid; here each point is a grid of its own, so they decide as without the word. So do while "
     "and for.",
     R"(surface stripes(color dark = 0.2;) {
    if (mod(s, 0.2) < 0.1)
        Ci = dark;
    else
        Ci = Cs;
}
)"},
    {"while", "while (condition) statement",
     "Repeats the statement as long as the condition holds. A loop of a million turns is stopped.",
     R"(surface doubling(float most = 100;) {
    float x = 1;
    while (x < most)
        x *= 2;
    Ci = x / most;
}
)"},
    {"for", "for (first; condition; step) statement",
     "Repeats the statement; the step runs behind each turn. Variables may be declared in front.",
     R"(surface octaves(float count = 4;) {
    float sum = 0;
    for (float i = 0; i < count; i += 1)
        sum += float noise(P * pow(2, i)) / pow(2, i + 1);
    Ci = sum;
}
)"},
    {"break", "break [levels];",
     "Leaves the loop, or so many loops around: while, for, illuminance or gather.",
     R"(surface first_ring(float rings = 8;) {
    float r = 0;
    for (r = 0; r < rings; r += 1)
        if (length(vector (s, t, 0)) * rings < r)
            break;
    Ci = r / rings;
}
)"},
    {"continue", "continue [levels];",
     "Goes on with the next turn of the loop, or of a loop around it.",
     R"(surface odd(float count = 5;) {
    float sum = 0;
    for (float i = 0; i < count; i += 1) {
        if (mod(i, 2) == 0)
            continue;
        sum += i;
    }
    Ci = sum / count;
}
)"},
    {"return", "return [value];", "Ends a function with its result. A function may have several.",
     R"(float tooth(float x) {
    if (x < 0.5)
        return 2 * x;
    return 2 - 2 * x;
}
surface teeth(float count = 10;) {
    Ci = tooth(mod(s * count, 1));
}
)"},
    {"illuminance",
     "illuminance([category,] position [, axis, angle] [, \"light:name\", variable ...]) statement",
     "Runs the statement once for each light that reaches the position, within the angle of the "
     "axis. L points to the light, Cl and Ol are what arrives. A category takes lights whose "
     "__category holds the name, \"-name\" all others. \"light:name\" reads a parameter of the "
     "light.",
     R"(surface wrapped(float soft = 0.3;) {
    normal Nf = faceforward(normalize(N), I);
    color light = 0;
    illuminance(P, Nf, PI / 2 + soft)
        light += Cl * max(0, (normalize(L) . Nf + soft) / (1 + soft));
    Ci = Cs * light;
}
)"},
    {"illuminate", "illuminate(position [, axis, angle]) statement",
     "In a light: light from a position, within the angle of the axis. L points from there to Ps; "
     "its length is the distance. The statement sets Cl.",
     R"(light lamp(float intensity = 4; color lightcolor = 1;) {
    illuminate(point "shader" (0, 0, 0), vector "shader" (0, 0, 1), PI / 6)
        Cl = intensity * lightcolor / (L . L);
}
)"},
    {"solar", "solar([axis, angle]) statement",
     "In a light: parallel light along the axis. An angle is that between the axis and the side of "
     "a cone, in radians: light comes from a disc of the sky, and shadows are soft. Without an "
     "axis "
     "it comes from all sides.",
     R"(light sun(float intensity = 1; color lightcolor = color (1, 0.95, 0.8);) {
    solar(vector "shader" (0, 0, 1), 0)
        Cl = intensity * lightcolor;
}
)"},
    {"gather",
     "gather(category, position, direction, angle, samples [, \"name\", value ...]) statement "
     "[else statement]",
     "Shoots rays into a cone and runs the statement for each that hits something, the other for "
     "each that does not. Results are surface:Ci Oi P N and outputs of the shader that is hit, "
     "ray:origin direction length, primitive:P N Ng u v s t. The category \"environment:MAP\" goes "
     "through directions without rays and gives environment:color direction solidangle.",
     R"(surface glossy(float samples = 16; float blur = 0.1;) {
    normal Nf = faceforward(normalize(N), I);
    color seen = 0, sum = 0;
    gather("illuminance", P, reflect(I, Nf), blur, samples, "surface:Ci", seen)
        sum += seen;
    Ci = Cs * sum / samples;
}
)"},
    {"extern", "extern type name, ...;",
     "In a function: the names mean the variables outside of it. Nested functions see them without "
     "it too.",
     R"(surface counted(float rings = 6;) {
    float calls = 0;
    float ring(float r) {
        extern float calls;
        calls += 1;
        return mod(r * rings, 1);
    }
    Ci = ring(s) * ring(t) / calls;
}
)"},
};

constexpr ManualEntry kTypes[] = {
    {"float", "float name",
     "A number of 32 bits. There are no integers and no truth values: a condition compares.",
     R"(surface ramp(float steps = 6;) {
    float stair = floor(s * steps) / (steps - 1);
    Ci = stair;
}
)"},
    {"color", "color name; color [\"space\"] (x, y, z)",
     "Three channels, rgb unless a space says otherwise. Of two colors * is taken by channel; a "
     "float stands for three equal channels. comp(c, 0), or c[0], is the first.",
     R"(surface sunset(color low = color "hsv" (0.05, 0.9, 1);) {
    Ci = mix(low, color(0.1, 0.2, 0.5), t);
}
)"},
    {"point vector normal", "point name; point [\"space\"] (x, y, z)",
     "A place, a direction or a normal, kept in \"current\" space. A named space is where the "
     "three numbers are read; transform(), vtransform() and ntransform() go the other way. a . b "
     "is the dot product, a ^ b the cross product.",
     R"(surface spots(float size = 0.5;) {
    point here = transform("object", P);
    vector off = here - point "object" (0, 0, 0);
    normal Nn = normalize(N);
    Ci = (length(off) < size ? 1 : 0.3) * abs(Nn . normalize(I));
}
)"},
    {"matrix", "matrix name; matrix [\"space\"] number or (16 numbers)",
     "Four rows of four. A number stands for that multiple of the identity. comp(m, row, column) "
     "is an element, transform(m, p) moves a point.",
     R"(surface turned(float degrees = 45;) {
    matrix m = rotate(matrix 1, radians(degrees), vector(0, 0, 1));
    point p = transform(m, point(s, t, 0));
    Ci = mod(8 * abs(xcomp(p)), 1);
}
)"},
    {"string", "string name",
     "A text: a file, a space or a channel. == and != compare; concat(), format() and match() "
     "make and search texts.",
     R"(surface picture(string file = "";) {
    Ci = file == "" ? Cs : color texture(file);
}
)"},
    {"void", "void name(parameters) { ... }", "Of a function: it has no result.",
     R"(void darken(output color c; float by;) { c *= 1 - by; }
surface shadowed(float by = 0.5;) {
    Ci = Cs;
    darken(Ci, by);
}
)"},
};

constexpr ManualEntry kStorage[] = {
    {"uniform", "uniform type name",
     "One value for all points. A varying value cannot be assigned to it. Parameters of shaders "
     "are uniform where nothing is said.",
     R"(surface tilted(uniform float degrees = 30;) {
    uniform float turn = radians(degrees);
    Ci = mod(10 * (s * cos(turn) + t * sin(turn)), 1);
}
)"},
    {"varying", "varying type name",
     "A value for each point. A varying parameter takes the vertex attribute of its name.",
     R"(surface painted(varying color Cpaint = 1;) {
    Ci = Cpaint * diffuse(faceforward(normalize(N), I));
}
)"},
    {"output", "output type name",
     "Of a function's parameter: what is assigned to it reaches the caller's variable. Of a "
     "shader's parameter: others read it, and kinora-render --aov makes a picture of it.",
     R"(void split(color c; output float most, least;) {
    most = max(comp(c, 0), comp(c, 1), comp(c, 2));
    least = min(comp(c, 0), comp(c, 1), comp(c, 2));
}
surface saturation(output varying float spread = 0;) {
    float most, least;
    split(Cs, most, least);
    spread = most - least;
    Ci = spread;
}
)"},
    {"constant", "constant type name",
     "RSL 2.0. A uniform value that is set once, by its first value or in construct().",
     R"(class striped(float count = 8;) {
    constant float width = 1 / count;
    public void surface(output color Ci, Oi) { Ci = Oi * step(0.5, mod(s / width, 1)); }
}
)"},
};

constexpr ManualEntry kObjects[] = {
    {"array resizable", "type name[];",
     "RSL 2.0. An array whose length changes: resize(), push(), pop(), reserve() and "
     "arraylength(). "
     "It begins empty, or with the values or the length given. The length may differ between "
     "points. It has room for what resize(), reserve() or a list of values names. Where a loop or "
     "a number known at run time decides, it has room for 4096 elements. What is beyond is left "
     "out and reported.",
     R"(surface rings(float count = 5;) {
    float radii[], k;
    for (k = 1; k <= count; k += 1) push(radii, k / count * 0.5);
    float inside = 0;
    for (k = 0; k < arraylength(radii); k += 1)
        inside += step(distance(point(s, t, 0), point(0.5, 0.5, 0)), radii[k]);
    Ci = inside / count;
}
)"},
    {"struct ->", "struct name { members; methods }",
     "RSL 2.0. Variables and functions together. a->x is a member and a->f(x) a call of a method, "
     "which names its object's members alone or as this->x. Structs are assigned whole, passed by "
     "reference and returned; members may be structs, and there are arrays of structs.",
     R"(struct Facing {
    normal n = 0;
    float front = 0;
    void init() {
        n = normalize(N);
        front = abs(n . normalize(I));
    }
    color shade(color c) { return c * mix(0.2, 1, front); }
}
surface glow(color tint = color(1, 0.6, 0.2);) {
    Facing f;
    f->init();
    Ci = f->shade(tint) * (1 - f->front);
}
)"},
    {"class public private this", "class name(parameters) { members; methods }",
     "RSL 2.0. A shader of several methods. The renderer calls construct, begin, "
     "displacement(P, N), opacity(Oi), prelighting(Ci, Oi), lighting(Ci, Oi) and postlighting. A "
     "class without lighting has diffuselighting and specularlighting instead, or surface. Where "
     "opacity() leaves 0 the rest is not run, and rays that ask for opacity alone run nothing "
     "behind it. Instead a class may have light(L, Cl), volume(Ci, Oi) or displacement alone. "
     "What a method writes to a member the next one reads at the same point.",
     R"(class leaf(color green = color(0.1, 0.5, 0.1);) {
    float across = 0;
    public void begin() { across = abs(s - 0.5) * 2; }
    public void opacity(output color Oi) { Oi = step(across, sqrt(t * (1 - t)) * 2); }
    public void surface(output color Ci, Oi) {
        Ci = Oi * green * (1 - 0.5 * smoothstep(0, 0.1, across)) * diffuse(normalize(N));
    }
}
)"},
};

constexpr ManualEntry kHandles[] = {
    {"shader null getshader getshaders hasmethod",
     "getshader(\"handle\"), getshaders([\"category\", name]), hasmethod(shader, \"method\")",
     "RSL 2.0. Co-shaders: shaders that another one calls. getshader() gives the one of that "
     "handle, or null; getshaders() those of a category, as a shader[]. h->f(x) calls a method, "
     "h->x reads a public member or a parameter. kinora-shade takes them by --coshader, a scene "
     "by stage=\"COSHADER\".",
     R"(class layered() {
    public void surface(output color Ci, Oi) {
        shader below = getshader("paint");
        color c = Cs;
        if (below != null)
            below->shade(c);
        Oi = 1;
        Ci = c * diffuse(faceforward(normalize(N), I));
    }
}
)"},
    {"getvar", "getvar(shader, \"name\", variable)",
     "RSL 2.0. 1, and the variable set, if the shader has a public member or a parameter of that "
     "name; else 0. Of null it is this shader's own, a global, or else what the mesh brings at "
     "each "
     "vertex under that name; readprimvar(\"name\", variable) is the same. The name may be made at "
     "run time. A resizable array takes the length of what it gets.",
     R"(surface tinted(color own = color(0.8, 0.2, 0.2);) {
    color tint = own;
    getvar(getshader("paint"), "tint", tint);
    Ci = tint * diffuse(faceforward(normalize(N), I));
}
)"},
    {"getlights", "getlights([\"category\", name])",
     "RSL 2.0. The lights of the scene as a shader[]; l->light(L, Cl) gives the vector from the "
     "light and its color at P.",
     R"(class lit(float Kd = 0.8;) {
    public void surface(output color Ci, Oi) {
        shader lamps[] = getlights();
        vector fall;
        color sent, sum = 0;
        float k;
        for (k = 0; k < arraylength(lamps); k += 1) {
            lamps[k]->light(fall, sent);
            sum += sent * max(0, normalize(N) . normalize(-fall));
        }
        Oi = 1;
        Ci = Kd * sum;
    }
}
)"},
};

constexpr ManualEntry kLines[] = {
    {"#define #undef", "#define NAME[(parameters)] text, #undef NAME",
     "The text stands for the name from here on. ## joins two tokens, # makes a text of one.",
     R"(#define STEPS 5
#define sqr(x) ((x) * (x))
surface rounded() {
    Ci = floor(STEPS * sqr(s)) / STEPS;
}
#undef STEPS
)"},
    {"#include", "#include \"file\" or #include <file>",
     "The file's text stands here. It is sought beside the including file and in the folders of "
     "-I. "
     "The customary headers are built in.",
     R"(#include "noises.h"
surface clouds(float scale = 3;) {
    Ci = 0.5 + 0.5 * snoise(transform("shader", P) * scale);
}
)"},
    {"#if #ifdef #ifndef #elif #else #endif defined",
     "#if expression, #ifdef NAME, #ifndef NAME ... #elif expression ... #else ... #endif",
     "The text between counts if the expression is not 0. defined(NAME) is 1 for a macro. Kinora "
     "defines KINORA.",
     R"(#ifdef KINORA
#define SAMPLES 4
#elif defined(FAST)
#define SAMPLES 1
#else
#define SAMPLES 16
#endif
surface shaded() {
    Ci = 1 - occlusion(P, normalize(N), SAMPLES);
}
)"},
    {"#error #warning", "#error text, #warning text", "A finding with the text.",
     R"(#ifndef KINORA
#error this shader needs Kinora's gather
#endif
surface plain() {
    Ci = Cs;
}
)"},
    {"__LINE__ __FILE__", "__LINE__, __FILE__",
     "The number of the line and the name of the file, where they are written.",
     R"(surface noted() {
    if (s < 0)
        printf("%s, line %g: s is %g\n", __FILE__, __LINE__, s);
    Ci = s;
}
)"},
    {"#pragma #line", "#pragma once, #pragma annotation ..., #line number",
     "#pragma once reads a header only once. Others are kept for tools that read them, and #line "
     "is "
     "passed over.",
     R"(#pragma annotation "comment" "a wall"
surface wall() {
    Ci = Cs;
}
)"},
};

#define KINORA_EFFECT(stage)                                         \
    "<effect id=\"look\"><profile_RSL><technique sid=\"default\">\n" \
    "  <code><![CDATA[ the shader ]]></code>\n"                      \
    "  <pass><shader stage=\"" stage                                 \
    "\"/></pass>\n"                                                  \
    "</technique></profile_RSL></effect>\n"
#define KINORA_MATERIAL "<material id=\"m\"><instance_effect url=\"#look\"/></material>\n"
#define KINORA_BOUND                                                        \
    "<instance_geometry url=\"#shape\"><bind_material><technique_common>\n" \
    "  <instance_material symbol=\"the mesh's\" target=\"#m\"/>\n"          \
    "</technique_common></bind_material></instance_geometry>\n"

constexpr ManualEntry kKindEntries[] = {
    {"surface", "surface name(parameters) { ... }",
     "The look of an object: sets Ci, the color that leaves P towards the eye, and Oi, its "
     "opacity.",
     R"(surface plaster(float Ka = 1, Kd = 0.9;) {
    normal Nf = faceforward(normalize(N), I);
    Oi = Os;
    Ci = Oi * Cs * (Ka * ambient() + Kd * diffuse(Nf));
}
)",
     KINORA_EFFECT("SURFACE") KINORA_MATERIAL KINORA_BOUND},
    {"displacement", "displacement name(parameters) { ... }", "Moves P, or bends N alone.",
     R"(displacement dents(float depth = 0.1, scale = 4;) {
    P -= depth * float noise(scale * transform("shader", P)) * normalize(N);
    N = calculatenormal(P);
}
)",
     KINORA_EFFECT("DISPLACEMENT") KINORA_MATERIAL KINORA_BOUND},
    {"light", "light name(parameters) { ... }",
     "What a lamp sends: Cl, in illuminate or solar; without them it is ambient. \"shader\" space "
     "is "
     "x right, y up, z where the light looks. A material with this stage makes its geometry shine.",
     R"(light bulb(float intensity = 2; color lightcolor = 1;) {
    illuminate(P)
        Cl = intensity * lightcolor / (L . L);
}
)",
     KINORA_EFFECT("LIGHT") "<light id=\"lamp\"><technique_common><point><color>1 1 "
                            "1</color></point></technique_common>\n"
                            "  <extra><technique profile=\"RSL\"><instance_effect "
                            "url=\"#look\"/></technique></extra>\n"
                            "</light>\n"},
    {"volume atmosphere", "volume name(parameters) { ... }",
     "What lies between P and the eye: changes Ci and Oi of what is behind it, over the ray I.",
     R"(volume haze(float distance = 20; color background = 0.5;) {
    float d = 1 - exp(-length(I) / distance);
    Ci = mix(Ci, background, d);
    Oi = mix(Oi, color 1, d);
}
)",
     KINORA_EFFECT("VOLUME") "<visual_scene id=\"scene\"> ...\n"
                             "  <extra><technique profile=\"RSL\"><instance_effect "
                             "url=\"#look\"/></technique></extra>\n"
                             "</visual_scene>\n"
                             "Inside of an object: a material, bound as that of a surface, with\n"
                             "  <extra><technique profile=\"RSL\" target=\"interior\"/></extra>\n"},
    {"imager", "imager name(parameters) { ... }",
     "Runs over the pixels of the finished picture: changes Ci, Oi and alpha. P is the pixel.",
     R"(imager tint(color shade = color (1, 0.9, 0.8);) {
    Ci *= shade;
}
)",
     KINORA_EFFECT("IMAGER") "<visual_scene id=\"scene\"> ...\n"
                             "  <extra><technique profile=\"RSL\"><instance_effect "
                             "url=\"#look\"/></technique></extra>\n"
                             "</visual_scene>\n"},
    {"transformation deformation", "transformation name(parameters) { ... }",
     "Moves the vertices of a mesh: P, and N. \"deformation\" is another word for it.",
     R"(transformation twist(float amount = 1;) {
    P = rotate(P, amount * zcomp(P), point (0, 0, 0), point (0, 0, 1));
}
)",
     KINORA_EFFECT("TRANSFORMATION") KINORA_MATERIAL KINORA_BOUND},
};

constexpr ManualChapter kChapters[] = {
    {"Statements", kStatements},
    {"Types", kTypes},
    {"Storage classes", kStorage},
    {"Arrays, structs and classes of RSL 2.0", kObjects},
    {"Co-shaders and lights as shaders", kHandles},
    {"Preprocessor lines", kLines},
    {"Kinds of shader, and how a scene uses them", kKindEntries},
};

}  // namespace

bool ManualEntry::has_name(std::string_view name) const {
    std::string_view rest = names;
    while (!rest.empty()) {
        size_t end = rest.find(' ');
        std::string_view word = rest.substr(0, end);
        if (word == name ||
            (word.starts_with("#") && word.substr(1) == name && word != "#else" && word != "#if"))
            return true;
        rest = end == rest.npos ? std::string_view() : rest.substr(end + 1);
    }
    return false;
}

std::span<const ManualChapter> manual_chapters() {
    return kChapters;
}

}  // namespace kinora
