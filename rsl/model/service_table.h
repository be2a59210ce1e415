// rsl/model/service_table.h: a renderer's services, found by name.
#pragma once

#include <algorithm>
#include <span>
#include <string_view>

#include "jit/ir/kernel.h"
#include "rsl/model/renderer_services.h"
#include "rsl/model/string_functions.h"

namespace kinora::rsl {

struct ServiceRow {
    std::string_view name;
    jit::ServiceFn function;
};

// Whether the rows and rsl's own string services are all of kServiceNames: for a static_assert
// behind a renderer's table.
constexpr bool has_all_services(std::span<const ServiceRow> rows) {
    return std::ranges::all_of(kServiceNames, [&](std::string_view name) {
        return std::ranges::find(rows, name, &ServiceRow::name) != rows.end() ||
               std::ranges::find(kStringServices, name) != std::end(kStringServices);
    });
}

// The function of a name that a kernel lists. An unknown name is a mistake of ours: the program
// stops.
jit::ServiceFn find_service(std::span<const ServiceRow> rows, std::string_view name);

}  // namespace kinora::rsl
