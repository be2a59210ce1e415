// rsl/builtins/points.cpp: point files and photon maps.
#include "rsl/builtins/table.h"
#include "rsl/lower/builtin_call.h"
#include "rsl/model/pairs.h"
#include "rsl/reference/reference_p.h"
#include "rsl/reference/service_calls_p.h"

namespace kinora::rsl {

namespace lower_points {

// Channels as the services take them: "float _area,color _radiosity" and their numbers in a row.
struct Channels {
    std::string text;
    std::vector<Value> numbers;
    void add(const std::string& name, const Lowered& value) {
        text += (text.empty() ? "" : ",") + std::string(type_name(value.type)) + " " + name;
        numbers.insert(numbers.end(), value.c.begin(), value.c.begin() + value.size());
    }
};

// A point as the services take it: in current space with scale 1, or in the space of the pair
// "coordsystem" with minus the length there of what has length 1 in current space.
struct FilePoint {
    V3 P, N;
    Value scale;
};
FilePoint file_point(LowerCall& c, int at) {
    auto& e = c.e;
    FilePoint point{c.v3(at), c.v3(at + 1), c.b.f(1)};
    Value name = c.has_pair("coordsystem") ? c.text_pair("coordsystem") : c.b.i(intern("world"));
    const std::string* text = e.constant_text(name);
    // The renderer's own way to world space, in double, but that it takes current for the camera's.
    bool of_camera = !c.context.options.of_vertices && !c.context.bends_normals();
    if (text && (*text == "world" || text->empty()) && of_camera) return point;
    if (text && text->empty()) name = c.b.i(intern("world"));
    auto space = c.spaces.space(name, c.where());
    point.P = c.spaces.from_current(lowered(BaseType::Point, point.P), space).v3();
    point.N = e.normalize(c.spaces.from_current(lowered(BaseType::Normal, point.N), space).v3());
    point.scale = e.f(-1);
    if (space.identity) return point;
    const Lowered& m = space.from_current;
    Value squares = e.f(0);  // of the axes' lengths
    for (size_t row = 0; row < 3; ++row) {
        V3 axis = {m.c[row * 4], m.c[row * 4 + 1], m.c[row * 4 + 2]};
        squares = c.b.add(squares, e.dot(axis, axis));
    }
    point.scale = c.b.neg(e.sqrt(c.b.mul(squares, e.f(1.0f / 3))));
    return point;
}

// bake3d(file, channels, P, N, "channel", value, ...) or without the list of channels.
void bake3d(LowerCall& c) {
    c.set(c.b.f(1));
    if (!c.context.options.want_Ci) return;
    int at = c.args.size() == 4 ? 2 : 1;
    Channels channels;
    for (auto& [name, value] : c.pairs)
        if (!takes_option(c.call.name, name) && value.type != BaseType::String)
            channels.add(name, value);
    if (channels.numbers.size() > size_t(kPointFloats)) {
        c.context.error(Code::RSL_TOO_MANY_CHANNELS, c.where(), channels.numbers.size(),
                        kPointFloats);
        return;
    }
    auto [P, N, scale] = file_point(c, at);
    c.context.out.uses_rng = true;
    std::vector<Value> args = {c.args[0].c[0],
                               c.b.i(intern(channels.text)),
                               rng_input(c.b),
                               P[0],
                               P[1],
                               P[2],
                               N[0],
                               N[1],
                               N[2],
                               c.b.max(c.pair("radius", 0), c.b.f(0)),
                               c.b.mul(scale, c.b.max(c.pair("radiusscale", 1), c.b.f(0)))};
    channels.numbers.resize(size_t(kPointFloats), c.b.f(0));
    args.insert(args.end(), channels.numbers.begin(), channels.numbers.end());
    c.services.call(Service::bake3d, args);
}

// Each "channel", variable pair is set if the file has the channel; 1 if it has them all.
void texture3d(LowerCall& c) {
    auto& e = c.e;
    c.report_unknown_pairs();
    Channels channels;
    std::vector<Lowered> before;
    for (auto& [name, target] : c.output_pairs) {
        before.push_back(c.variables.load(target));
        before.back().type = target.type;
        channels.add(name, before.back());
    }
    if (channels.numbers.size() > size_t(kPointFloats)) {
        c.context.error(Code::RSL_TOO_MANY_CHANNELS, c.where(), channels.numbers.size(),
                        kPointFloats);
        return;
    }
    auto [P, N, scale] = file_point(c, 1);
    std::vector<Value> answer =
        c.services.call(Service::texture3d, std::array{c.args[0].c[0], c.b.i(intern(channels.text)),
                                                       P[0], P[1], P[2], N[0], N[1], N[2], scale});
    size_t next = 1;
    Value all = c.b.m(true);
    for (size_t k = 0; k < c.output_pairs.size(); ++k) {
        Value bit = c.b.iand(answer[0], c.b.i(int32_t(1u << k)));
        Value known = c.b.logical_not(c.b.op(jit::Op::IEq, bit, c.b.i(0)));
        all = c.b.logical_and(all, known);
        Lowered value = before[k];
        for (size_t i = 0; i < size_t(value.size()); ++i)
            value.c[i] = c.b.select(known, answer[next++], value.c[i]);
        c.variables.store(c.output_pairs[k].second, value);
    }
    c.set(e.flag(all));
}

template <PhotonKind kind>
void photons(LowerCall& c) {
    auto& e = c.e;
    c.report_unknown_pairs();
    bool named = c.args[0].type == BaseType::String;
    size_t at = named ? 1 : 0;
    V3 P = c.v3(int(at));
    V3 N = c.args.size() > at + 1 ? c.v3(int(at) + 1) : e.f3(0);
    Value estimator = c.b.ftoi(c.pair("estimator", 50));
    Value file = named ? c.args[0].c[0] : c.text_pair("filename");
    std::vector<Value> light = c.services.call(
        Service::photons,
        std::array{file, c.b.i(int32_t(kind)), estimator, P[0], P[1], P[2], N[0], N[1], N[2]});
    c.set(V3{light[0], light[1], light[2]});
}

}  // namespace lower_points

namespace ref {
namespace {

template <class Real>
void photons(RefCall<Real>& c, PhotonKind kind) {
    bool named = c.args[0].type == BaseType::String;
    std::vector<double> args = {named ? double(c.args[0].c[0].x) : pair(c, "filename", 0),
                                double(int(kind)), double(int(pair(c, "estimator", 50)))};
    for (size_t k = named ? 1 : 0; k < c.args.size(); ++k) add(args, c.args[k]);
    args.resize(9, 0.0);
    set_from(c, c.eval.service(Service::photons, args));
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

}  // namespace
}  // namespace ref

namespace {

namespace lower = lower_points;

constexpr uint32_t kNames = kNamesFile | kNamesPoints;
constexpr uint32_t kLooksUp = kService | kVaryingResult | kNames;

const Builtin kRows[] = {
    {"texture3d", "f=spn~", lower::texture3d, KINORA_RSL_REF(ref::texture3d),
     kLooksUp | kReadsChannels, 0,
     "Values of a point file near P: texture3d(file, P, N, \"channel\", variable, ...), 1 if the "
     "file has all channels.",
     kSurface | kLight | kDisplacement | kVolume},
    {"bake3d", "f=spn~ f=sspn~", lower::bake3d, KINORA_RSL_REF(ref::bake3d),
     kService | kPrints | kWritesChannels | kVaryingResult | kNames, 0,
     "Puts a point into a point file, written after the frame: bake3d(file, channels, P, N, "
     "\"channel\", value, ...).",
     kSurface | kLight | kDisplacement},
    {"photonmap", "c=sp~ c=spn~", lower::photons<PhotonKind::Map>, KINORA_RSL_REF(ref::photonmap),
     kLooksUp, 0, "Photon power per area near P, of a point file with a channel \"power\".",
     kSurface | kLight | kVolume},
    {"caustic", "c=spn~ c=pn~", lower::photons<PhotonKind::Caustic>, KINORA_RSL_REF(ref::caustic),
     kLooksUp, 0, "As photonmap; without a file (or \"filename\") there are no caustics: 0.",
     kSurface | kLight},
    {"subsurface", "c=sp~ c=spn~ c=p~ c=pn~", lower::photons<PhotonKind::Subsurface>,
     KINORA_RSL_REF(ref::subsurface), kLooksUp, 0,
     "Mean of a point file's \"_ssdiffusion\" or \"_radiance_t\" near P; without a file 0.",
     kSurface | kLight},
};

}  // namespace

std::span<const Builtin> builtins_points() {
    return kRows;
}

}  // namespace kinora::rsl
