// rsl/reference/rays.cpp: built-ins over rays, point files, messages and questions, at one point:
// what to ask the renderer, and what its answer means.
#include "rsl/model/pairs.h"
#include "rsl/reference/reference_p.h"

namespace kinora::rsl::ref {

namespace {

template <class Real>
void add(std::vector<double>& args, const RefValue<Real>& value) {
    for (size_t k = 0; k < value.size(); ++k) args.push_back(double(value.c[k].x));
}
double at(const std::vector<double>& answer, size_t k) {
    return k < answer.size() ? answer[k] : 0;
}
template <class Real>
void set_from(RefCall<Real>& c, const std::vector<double>& answer, size_t first = 0) {
    for (size_t k = 0; k < c.result.size(); ++k)
        c.result.c[k] = Dual<Real>(Real(at(answer, first + k)));
}
// The seed is not the reference's to know: two zeros.
template <class Real>
std::vector<double> seeded(RefCall<Real>& c, size_t first, size_t count) {
    std::vector<double> args = {0, 0};
    for (size_t k = first; k < first + count; ++k) add(args, c.args[k]);
    return args;
}
template <class Real>
double pair(RefCall<Real>& c, std::string_view name, double otherwise) {
    return double(c.pair(name, Real(otherwise)).x);
}

template <class Real>
std::vector<double> ask_transmission(RefCall<Real>& c) {
    std::vector<double> args = seeded(c, 0, 2);
    for (double x : {pair(c, "samples", 1), pair(c, "samplecone", 0), pair(c, "bias", -1)})
        args.push_back(x);
    return c.eval.service(Service::transmission, args);
}

// Sets args[1] where the renderer knows the answer.
template <class Real>
void ask(RefCall<Real>& c, QueryKind kind) {
    const Type type = c.call.args[1]->type;
    int letter = "fcpvnms"[int(type.base)];
    std::vector<double> answer =
        c.eval.service(Service::query, {double(int(kind)), double(c.args[0].c[0].x), double(letter),
                                        type.is_array() ? 0.0 : -1.0, 1, 0});
    bool known = at(answer, 0) != 0;
    c.set(Dual<Real>(Real(known)));
    for (size_t k = 0; known && k < c.args[1].size(); ++k)
        c.args[1].c[k] = Dual<Real>(Real(at(answer, 1 + k)));
}

template <class Real>
void fact(RefCall<Real>& c, const char* name) {
    int letter = "fcpvnms"[int(c.result.type)];
    set_from(c,
             c.eval.service(Service::query, {double(int(QueryKind::RayInfo)), double(intern(name)),
                                             double(letter), -1, 1, 0}),
             1);
}

template <class Real>
void photons(RefCall<Real>& c, PhotonKind kind) {
    bool named = c.args[0].type == BaseType::String;
    std::vector<double> args = {named ? double(c.args[0].c[0].x) : pair(c, "filename", 0),
                                double(int(kind)), double(int(pair(c, "estimator", 50)))};
    for (size_t k = named ? 1 : 0; k < c.args.size(); ++k) add(args, c.args[k]);
    args.resize(9, 0.0);
    set_from(c, c.eval.service(Service::photons, args));
}

}  // namespace

template <class Real>
void trace(RefCall<Real>& c) {
    std::vector<double> args = seeded(c, 0, 2);
    for (double x : {pair(c, "maxdist", 1e30), pair(c, "bias", -1), pair(c, "samples", 1),
                     pair(c, "samplecone", 0), pair(c, "label", 0)})
        args.push_back(x);
    set_from(c, c.eval.service(Service::trace, args), c.result.type == BaseType::Float ? 3 : 0);
}
template <class Real>
void transmission(RefCall<Real>& c) {
    set_from(c, ask_transmission(c));
}
template <class Real>
void visibility(RefCall<Real>& c) {
    double sum = 0;
    for (double x : ask_transmission(c)) sum += x;
    c.set(Dual<Real>(Real(sum > 0 ? 1 : 0)));
}
template <class Real>
void occlusion(RefCall<Real>& c) {
    std::vector<double> args = seeded(c, c.args.size() == 4 ? 1 : 0, 3);
    for (double x :
         {pair(c, "coneangle", 1.5707963268), pair(c, "maxdist", 1e30), pair(c, "bias", -1),
          pair(c, "falloff", 0), pair(c, "falloffmode", 0), pair(c, "environmentmap", 0)})
        args.push_back(x);
    std::vector<double> answer = c.eval.service(Service::occlusion, args);
    set_from(c, answer);
    for (auto& [name, value] : c.pairs)
        for (auto [output, first] : {std::pair("environmentdir", 1), {"environmentcolor", 4}})
            for (size_t k = 0; k < 3 && name == output; ++k)
                value.c[k] = Dual<Real>(Real(at(answer, size_t(first) + k)));
}
template <class Real>
void indirectdiffuse(RefCall<Real>& c) {
    bool of_map = c.args[0].type == BaseType::String;
    std::vector<double> args = {0, 0};
    add(args, of_map ? c.eval.global(Global::P) : c.args[0]);
    add(args, c.args[1]);
    add(args, c.args[2]);
    for (double x :
         {pair(c, "coneangle", 1.5707963268), of_map ? 0 : pair(c, "maxdist", 1e30),
          pair(c, "bias", -1), of_map ? double(c.args[0].c[0].x) : pair(c, "environmentmap", 0)})
        args.push_back(x);
    std::vector<double> answer = c.eval.service(Service::indirectdiffuse, args);
    set_from(c, answer);
    for (auto& [name, value] : c.pairs)
        for (size_t k = 0; k < 3 && name == "environmentcolor"; ++k)
            value.c[k] = Dual<Real>(Real(at(answer, 3 + k)));
}
// By the middle of the light alone: what lies between is the renderer's random choice.
template <class Real>
void areashadow(RefCall<Real>& c) {
    std::vector<double> args = seeded(c, 1, 1);
    for (size_t k = 0; k < 3; ++k)
        args.push_back(0.5 * double(c.args[3].c[k].x + c.args[4].c[k].x));
    for (double x : {1.0, 0.0, pair(c, "bias", -1)}) args.push_back(x);
    std::vector<double> through = c.eval.service(Service::transmission, args);
    for (double& x : through) x = 1 - x;
    set_from(c, through);
}

template <class Real>
void photonmap(RefCall<Real>& c) {
    photons(c, PhotonKind::Map);
}
template <class Real>
void caustic(RefCall<Real>& c) {
    photons(c, PhotonKind::Caustic);
}
template <class Real>
void subsurface(RefCall<Real>& c) {
    photons(c, PhotonKind::Subsurface);
}
template <class Real>
void bake3d(RefCall<Real>& c) {  // what is written is no value of the point
    c.set(Dual<Real>(1));
}
template <class Real>
void texture3d(RefCall<Real>& c) {
    std::string channels;
    for (size_t k = c.call.pairs, p = 0; k + 1 < c.call.args.size(); k += 2) {
        if (c.call.args[k + 1]->type.is_array()) continue;
        auto& [name, value] = c.pairs[p++];
        if (is_output_pair(c.call, k + 1))
            channels +=
                (channels.empty() ? "" : ",") + std::string(type_name(value.type)) + " " + name;
    }
    std::vector<double> args = {double(c.args[0].c[0].x), double(intern(channels))};
    if (c.eval.bends_normals()) {  // in the file's space, with minus its scale
        auto world = c.eval.space("world", "from_current");
        RefValue<Real> P = c.args[1], N = c.args[2];
        P.type = BaseType::Point, N.type = BaseType::Normal;
        Vec<Real> n = normalize(vec(c.eval.by_matrix(N, world)));
        add(args, c.eval.by_matrix(P, world));
        add(args, RefValue<Real>(BaseType::Normal, n[0], n[1], n[2]));
        double squares = 0;
        for (size_t k = 0; k < 12; ++k)
            if (k % 4 < 3) squares += double(world[k].x) * double(world[k].x);
        args.push_back(-std::sqrt(squares / 3));
    } else {
        add(args, c.args[1]);
        add(args, c.args[2]);
        args.push_back(1);
    }
    std::vector<double> answer = c.eval.service(Service::texture3d, args);
    int bits = int(at(answer, 0)), all = 1;
    size_t next = 1;
    int channel = 0;
    for (size_t k = c.call.pairs, p = 0; k + 1 < c.call.args.size(); k += 2) {
        if (c.call.args[k + 1]->type.is_array()) continue;
        RefValue<Real>& value = c.pairs[p++].second;
        if (!is_output_pair(c.call, k + 1)) continue;
        bool known = bits >> channel++ & 1;
        all = all && known;
        for (size_t i = 0; i < value.size(); ++i, ++next)
            if (known) value.c[i] = Dual<Real>(Real(at(answer, next)));
    }
    c.set(Dual<Real>(Real(all)));
}

#define KINORA_ASK(name, kind)    \
    template <class Real>         \
    void name(RefCall<Real>& c) { \
        ask(c, QueryKind::kind);  \
    }
KINORA_ASK(surface_message, Surface)
KINORA_ASK(displacement_message, Displacement)
KINORA_ASK(atmosphere, Atmosphere)
KINORA_ASK(incident, Incident)
KINORA_ASK(opposite, Opposite)
KINORA_ASK(attribute, Attribute)
KINORA_ASK(option, Option)
KINORA_ASK(rendererinfo, RendererInfo)
KINORA_ASK(rayinfo, RayInfo)

#define KINORA_FACT(function, name)   \
    template <class Real>             \
    void function(RefCall<Real>& c) { \
        fact(c, name);                \
    }
KINORA_FACT(raydepth, "depth")
KINORA_FACT(raylabel, "label")
KINORA_FACT(rayorigin, "origin")
KINORA_FACT(raydirection, "direction")
KINORA_FACT(raylength, "length")

template <class Real>
void isshadowray(RefCall<Real>& c) {  // it looks as the camera does
    c.set(Dual<Real>(0));
}

// Laid out by hand: clang-format lays such lists out anew each time.
// clang-format off
#define KINORA_ALL(F) \
    F(trace) F(transmission) F(visibility) F(occlusion) F(indirectdiffuse) F(areashadow) \
    F(photonmap) F(caustic) F(subsurface) F(bake3d) F(texture3d) F(surface_message) \
    F(displacement_message) F(atmosphere) F(incident) F(opposite) F(attribute) F(option) \
    F(rendererinfo) F(rayinfo) F(raydepth) F(raylabel) F(rayorigin) F(raydirection) F(raylength) \
    F(isshadowray)
// clang-format on
KINORA_ALL(KINORA_RSL_DEFINE_REF)

}  // namespace kinora::rsl::ref
