// rsl/model/service_table.cpp: a renderer's services, found by name.
#include "rsl/model/service_table.h"

#include <string>

#include "runtime/base/check.h"

namespace kinora::rsl {

jit::ServiceFn find_service(std::span<const ServiceRow> rows, std::string_view name) {
    for (const ServiceRow& row : rows)
        if (row.name == name) return row.function;
    if (jit::ServiceFn function = string_service(name)) return function;
    check_failed("rsl/model/service_table.cpp", 0, "unknown service " + std::string(name));
}

}  // namespace kinora::rsl
