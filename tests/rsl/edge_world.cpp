// tests/rsl/edge_world.cpp: points, parameters, lights and services with anything that a float can
// be.
#include "tests/rsl/edge_world.h"

#include "rsl/model/service_table.h"
#include "runtime/base/check.h"
#include "tests/rsl/shading_world.h"

namespace kinora::rsl {

namespace {

bool one_of(std::string_view name, std::initializer_list<std::string_view> stems) {
    return std::find(stems.begin(), stems.end(), name.substr(0, name.find('.'))) != stems.end();
}

float signed_zero(Random& random) {
    return random.next() % 4 ? 0.0f : -0.0f;
}

// What becomes of a number of the input `name` at a point.
using Turn = float (*)(Random& random, std::string_view name, float x);

float as_it_is(Random&, std::string_view, float x) {
    return x;
}
float some_wild(Random& random, std::string_view, float x) {
    return random.next() % 4 ? x : random.wild();
}
float all_wild(Random& random, std::string_view, float) {
    return random.wild();
}
float coincident(Random& random, std::string_view name, float x) {
    return one_of(name, {"P", "Ps", "I", "E"}) ? signed_zero(random) : x;
}
float without_length(Random& random, std::string_view name, float x) {
    return one_of(name, {"N", "Ng", "Ns", "I"}) ? signed_zero(random) : x;
}
float without_slope(Random& random, std::string_view name, float x) {
    return one_of(name, {"dPdu", "dPdv", "dNdu", "dNdv", "dIdu", "dIdv", "dsdu", "dsdv", "dtdu",
                         "dtdv", "du", "dv"})
               ? signed_zero(random)
               : x;
}
float huge(Random& random, std::string_view, float x) {
    return x * (random.next() % 2 ? 1e30f : 3e38f);
}
float denormal(Random& random, std::string_view, float x) {
    return x * (random.next() % 2 ? 1e-40f : 1e-38f);
}

constexpr Turn kTurns[] = {as_it_is,       some_wild,     all_wild, coincident,
                           without_length, without_slope, huge,     denormal};

bool is_int(std::string_view name) {
    return name == "rng";
}

}  // namespace

Columns edge_points(uint64_t seed, size_t points) {
    Random random{seed * 77 + 13};
    Columns columns = random_point(seed, points);
    for (auto& [name, values] : columns)
        for (size_t i = 0; i < values.size() && !is_int(name); ++i)
            values[i] = kTurns[(seed + i) % std::size(kTurns)](random, name, values[i]);
    return columns;
}

std::vector<float> edge_column(Random& random, size_t points) {
    std::vector<float> values;
    for (size_t i = 0; i < points; ++i)
        values.push_back(kTurns[i % std::size(kTurns)](random, "", random.argument(false)));
    return values;
}

void bind_edges(const Shader& shader, Random& random, size_t points,
                std::vector<ParamBinding>& params, Columns& columns) {
    for (const ShaderParameter& p : shader.parameters) {
        if (p.type.base == BaseType::String) continue;
        bool varying = p.detail == Detail::Varying && !p.type.is_array();
        auto kind = varying ? ParamBinding::Kind::Varying : ParamBinding::Kind::Frame;
        params.push_back({std::string(p.name), kind, {}, {}});
        int components = component_count(p.type.base);
        for (int e = 0; e < (p.type.is_array() ? p.type.array_length : 1); ++e)
            for (int c = 0; c < components; ++c) {
                std::string name = "param:0:" + std::string(p.name);
                if (p.type.is_array()) name += "[" + std::to_string(e) + "]";
                if (p.type.base == BaseType::Color)
                    name += std::string(".") + "rgb"[c];
                else if (components == 3)
                    name += std::string(".") + "xyz"[c];
                else if (components > 3)
                    name += "." + std::to_string(c);
                std::vector<float> one = {random.next() % 2 ? random.wild()
                                                            : random.argument(false)};
                columns[name] = varying ? edge_column(random, points) : one;
            }
    }
}

// ---- what else the kernels read -----------------------------------------------------------------

namespace {

void add_missing_inputs(RunShader& run, Random& random, size_t points) {
    for (const jit::Kernel* kernel : {run.kernels.point.get(), run.kernels.frame.get()})
        for (size_t k = 0; kernel && k < kernel->inputs.size(); ++k) {
            const std::string& name = kernel->inputs[k].name;
            if (name == "1" || is_int(name) || run.inputs.count(name)) continue;
            bool matrix = name.rfind("space:", 0) == 0;
            if (kernel == run.kernels.frame.get() || matrix)
                run.inputs[name] = {random.next() % 8 ? random.uniform(-2, 2) : random.wild()};
            else
                run.inputs[name] = edge_column(random, points);
        }
}

void add_edge_lights(RunShader& run, Random& random, size_t points) {
    for (int k = 0; k < 4; ++k) {
        TestLight light;
        light.kind = k == 0 ? kLightAmbient : k == 1 ? kLightSolar : kLightIlluminate;
        for (int column = 0; column < kLightLit; ++column)
            light.columns.push_back(edge_column(random, points));
        for (size_t i = size_t(k); i < points; i += 3)  // as a gather reads it
            light.columns[kLightL][i] = std::bit_cast<float>(int32_t(kGatherHit));
        std::vector<float> lit;
        for (size_t i = 0; i < points; ++i)
            lit.push_back(std::bit_cast<float>(int32_t(random.next() % 3) - 1));
        light.columns.push_back(lit);
        light.categories = random.next();
        light.nondiffuse = k == 2 ? random.wild() : 0;
        light.nonspecular = k == 3 ? random.wild() : 0;
        for (size_t j = 0; j < run.lowered.light_messages.size(); ++j) {
            bool text = run.lowered.light_message_types[j].base == BaseType::String;
            for (int c = 0; c < run.lowered.light_message_components[j]; ++c)
                light.messages.push_back(text ? std::bit_cast<float>(intern("world"))
                                              : random.wild());
        }
        run.lights.push_back(light);
    }
}

// Results that are ints: how many values follow, handles of record sets, ids of strings.
void repair_ints(Service service, int32_t type, Random& random, std::span<float> results) {
    auto whole = [&](size_t k, int32_t value) { results[k] = std::bit_cast<float>(value); };
    if (service == Service::lights || service == Service::gather) {
        whole(0, 0);  // one answer for all lanes: the lights
    } else if (service == Service::query && type == 's') {
        whole(0, int32_t(random.next() % 2));
        for (size_t k = 1; k < results.size(); ++k) whole(k, intern("world"));
    } else if (service == Service::textureinfo) {
        whole(0, int32_t(random.next() % 18) - 1);
        if (std::bit_cast<int32_t>(results[0]) < 0) whole(1, intern("texture"));
    } else if (service == Service::query || service == Service::texture3d) {
        whole(0, int32_t(random.next() % 4));
    }
}

// A hash of a lane's arguments, in which any NaN is one.
uint64_t argument_hash(Service service, const jit::ServiceCall& call, int lane) {
    uint64_t hash = uint64_t(service) + 1;
    auto add = [&](const ServiceValue& value) {
        for (int k = value.first; k < value.first + value.width(); ++k) {
            float x = call.args[k * jit::kMaxLanes + lane];
            uint32_t bits = value.kind != 'i' && x != x ? 0x7fc00000 : std::bit_cast<uint32_t>(x);
            hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
        }
    };
    for_each_service_value(service_form(service).arguments, add);
    return hash;
}

// The same for the same bits of the arguments.
template <Service service>
void edge_service(const jit::ServiceCall& call) {
    RunShader& run = *static_cast<RunShader*>(call.grid);
    float results[result_count(service) + 1];
    for (int lane = 0; lane < call.lanes; ++lane) {
        if (!(call.mask >> lane & 1)) continue;
        Random random{argument_hash(service, call, lane)};
        // A sum, as lanes have no order.
        uint64_t told = random.state ^ uint64_t(call.first + lane);
        if (!service_form(service).pure) run.told += told * 0xbf58476d1ce4e5b9u;
        std::span<float> answer(results, size_t(result_count(service)));
        for (float& x : answer) x = random.next() % 2 ? random.uniform(0, 1) : random.wild();
        int32_t type = 0;
        if constexpr (service == Service::query)
            type = std::bit_cast<int32_t>(
                call.args[service_argument(service, "type").first * jit::kMaxLanes + lane]);
        repair_ints(service, type, random, answer);
        for (size_t k = 0; k < answer.size(); ++k)
            call.results[k * jit::kMaxLanes + size_t(lane)] = answer[k];
    }
}

constexpr ServiceTable kEdgeWorld = {
#define SERVICE(name, arguments, results, effects, doc) edge_service<Service::name>,
#define STRING_SERVICE(name, arguments, results, effects, doc)
#include "rsl/model/services.def"
};

}  // namespace

void add_edge_world(RunShader& run, uint64_t seed, size_t points) {
    Random random{seed * 31 + 7};
    add_missing_inputs(run, random, points);
    add_edge_lights(run, random, points);
    run.set_services(kEdgeWorld);
}

}  // namespace kinora::rsl
