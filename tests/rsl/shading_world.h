// tests/rsl/shading_world.h: random points, lights and services that kernels and the reference see
// alike.
#pragma once

#include "tests/rsl/differential.h"

namespace kinora::rsl {

// A curved patch lit from three sides.
inline Columns random_point(uint64_t seed, size_t points) {
    Random r{seed};
    Columns c;
    auto triple = [&](const std::string& name, auto make, const char* parts = "xyz") {
        for (int k = 0; k < 3; ++k)
            for (size_t i = 0; i < points; ++i) c[name + "." + parts[k]].push_back(make(k));
    };
    triple("P", [&](int) { return r.uniform(-3, 3); });
    triple("Ps", [&](int) { return r.uniform(-3, 3); });
    triple("dPdu", [&](int k) { return k == 0 ? r.uniform(0.5f, 2) : r.uniform(-0.3f, 0.3f); });
    triple("dPdv", [&](int k) { return k == 1 ? r.uniform(0.5f, 2) : r.uniform(-0.3f, 0.3f); });
    for (const char* name : {"dNdu", "dNdv", "dIdu", "dIdv"})
        triple(name, [&](int) { return r.uniform(-0.2f, 0.2f); });
    for (const char* name : {"Ci", "Oi"})  // behind a volume or imager
        triple(
            name, [&](int) { return r.uniform(0, 1); }, "rgb");
    for (const char* name : {"N", "Ng", "Ns"})
        triple(name, [&](int k) { return k == 2 ? r.uniform(-1, -0.5f) : r.uniform(-0.5f, 0.5f); });
    triple("I", [&](int k) { return k == 2 ? r.uniform(1, 5) : r.uniform(-1, 1); });
    for (const char* name : {"u", "v", "s", "t", "alpha"})
        for (size_t i = 0; i < points; ++i) c[name].push_back(r.uniform(0, 1));
    for (const char* name : {"dsdu", "dsdv", "dtdu", "dtdv", "du", "dv"})
        for (size_t i = 0; i < points; ++i) c[name].push_back(r.uniform(0.01f, 0.1f));
    for (size_t i = 0; i < points; ++i) c["rng"].push_back(std::bit_cast<float>(r.next() >> 4));
    c["time"] = {0.25f};
    c["dtime"] = {0.02f};
    return c;
}

// What services answer, the same for kernels and the reference: smooth in a few arguments.
inline double answer(Service service, const double* args, int result) {
    bool seeded = service == Service::trace || service == Service::transmission;
    bool of_map = service == Service::texture || service == Service::environment;
    int first = seeded || of_map ? 2 : service == Service::shadow ? 1 : 0;
    int count = service == Service::texture ? 2 : 3;
    double sum = 0.3 * result;
    for (int k = 0; k < count; ++k) sum += args[first + k] * (0.7 + 0.2 * k);
    return 0.5 + 0.4 * std::sin(sum);
}
constexpr int kAnswerArguments = 6;

template <Service service>
void answer_smoothly(const jit::ServiceCall& call) {
    for (int lane = 0; lane < call.lanes; ++lane) {
        double args[kAnswerArguments] = {};
        for (int k = 0; k < std::min(kAnswerArguments, argument_count(service)); ++k)
            args[k] = double(call.args[k * jit::kMaxLanes + lane]);
        for (int k = 0; k < result_count(service); ++k)
            call.results[k * jit::kMaxLanes + lane] = float(answer(service, args, k));
    }
}

inline void gather_nothing(const jit::ServiceCall& call) {
    std::fill_n(call.results, jit::kMaxLanes, std::bit_cast<float>(RunShader::kNoRecords));
}

// Of the others all is 0, for kernels and the reference.
inline constexpr ServiceTable kSmoothWorld = {
    .lights = answer_zeros<Service::lights>,
    .samplinglights = answer_zeros<Service::samplinglights>,
    .samplewish = answer_zeros<Service::samplewish>,
    .lightsample = answer_zeros<Service::lightsample>,
    .stratified = answer_zeros<Service::stratified>,
    .texture = answer_smoothly<Service::texture>,
    .environment = answer_smoothly<Service::environment>,
    .maplight = answer_zeros<Service::maplight>,
    .mapdensity = answer_zeros<Service::mapdensity>,
    .mapdirection = answer_zeros<Service::mapdirection>,
    .shadow = answer_smoothly<Service::shadow>,
    .textureinfo = answer_zeros<Service::textureinfo>,
    .trace = answer_smoothly<Service::trace>,
    .transmission = answer_smoothly<Service::transmission>,
    .occlusion = answer_zeros<Service::occlusion>,
    .indirectdiffuse = answer_zeros<Service::indirectdiffuse>,
    .gather = gather_nothing,
    .raylimit = answer_zeros<Service::raylimit>,
    .query = answer_zeros<Service::query>,
    .bake3d = answer_zeros<Service::bake3d>,
    .texture3d = answer_zeros<Service::texture3d>,
    .photons = answer_zeros<Service::photons>,
    .transform = answer_smoothly<Service::transform>,
    .print = answer_zeros<Service::print>,
};

inline std::vector<double> reference_service(Service service, std::span<const double> args) {
    constexpr Service kAnswered[] = {Service::texture, Service::environment, Service::shadow,
                                     Service::trace, Service::transmission};
    if (std::find(std::begin(kAnswered), std::end(kAnswered), service) == std::end(kAnswered))
        return {};
    double padded[kAnswerArguments] = {};
    std::copy_n(args.begin(), std::min<size_t>(args.size(), kAnswerArguments), padded);
    std::vector<double> results;
    for (int k = 0; k < result_count(service); ++k)
        results.push_back(double(float(answer(service, padded, k))));
    return results;
}

inline void add_services(RunShader& run) {
    run.set_services(kSmoothWorld);
}

inline void add_lights(RunShader& run, ReferenceInputs& inputs) {
    for (int k = 0; k < 4; ++k) {
        TestLight light;
        ReferenceLight same;
        light.kind = same.kind = k == 0 ? kLightAmbient : k == 1 ? kLightSolar : kLightIlluminate;
        const float L[4][3] = {{0, 0, 0}, {0.6f, 0, -0.8f}, {1, 2, -3}, {-2, 0.5f, -0.5f}};
        for (size_t c = 0; c < 3; ++c) {
            light.L[c] = L[k][c], same.L[c] = double(L[k][c]);
            light.Cl[c] = 0.2f * float(k + 1) + 0.1f * float(c), same.Cl[c] = double(light.Cl[c]);
            same.Ol[c] = 1;
        }
        if (k == 3) light.nonspecular = 1, same.nonspecular = 1;
        for (size_t j = 0; j < run.lowered.categories.size(); ++j)
            if (int(j) % 2 == k % 2) {
                light.categories |= 1u << j;
                same.categories.push_back(run.lowered.categories[j]);
            }
        for (size_t j = 0; j < run.lowered.light_messages.size(); ++j) {
            bool text = run.lowered.light_message_types[j].base == BaseType::String;
            std::vector<double> value;
            for (int c = 0; c < run.lowered.light_message_components[j]; ++c) {
                value.push_back(text ? double(intern("world")) : 0.25 * (k + c));
                light.messages.push_back(text ? std::bit_cast<float>(int32_t(value.back()))
                                              : float(value.back()));
            }
            same.messages.emplace_back(run.lowered.light_messages[j], value);
        }
        run.lights.push_back(light);
        inputs.lights.push_back(same);
    }
}

inline bool same_bits(float a, float b) {
    return std::bit_cast<int32_t>(a) == std::bit_cast<int32_t>(b) ||
           (std::isnan(a) && std::isnan(b));
}

}  // namespace kinora::rsl
