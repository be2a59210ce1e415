// rsl/model/service_table.h: a renderer's functions, one for each service.
#pragma once

#include <algorithm>
#include <string_view>

#include "jit/ir/kernel.h"
#include "rsl/model/services.h"

namespace kinora::rsl {

// Not null, and without a default: a table that leaves a service out does not compile.
struct ServiceFunction {
    constexpr ServiceFunction(jit::ServiceFn function) : call(function) {}
    jit::ServiceFn call;
};

// Written as rows: {.lights = lights, .texture = texture, ...}.
struct ServiceTable {
#define SERVICE(name, arguments, results, effects, doc) ServiceFunction name;
#define STRING_SERVICE(name, arguments, results, effects, doc)
#include "rsl/model/services.def"

    jit::ServiceFn operator[](Service service) const;  // string services included
};

// The function of a name that a kernel lists. An unknown name is a mistake of ours: the program
// stops.
jit::ServiceFn find_service(const ServiceTable& table, std::string_view name);

// The answer of a renderer that knows nothing: all results are 0 in all lanes.
template <Service service>
void answer_zeros(const jit::ServiceCall& call) {
    std::fill_n(call.results, result_count(service) * jit::kMaxLanes, 0.0f);
}

}  // namespace kinora::rsl
