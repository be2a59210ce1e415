// rsl/model/service_table.cpp: services by name and by their row.
#include "rsl/model/service_table.h"

#include <string>

#include "rsl/model/string_functions.h"
#include "runtime/base/check.h"

namespace kinora::rsl {

std::optional<Service> find_service(std::string_view name) {
    for (Service service : kServices)
        if (service_name(service) == name) return service;
    return {};
}

jit::ServiceFn ServiceTable::operator[](Service service) const {
    switch (service) {
#define SERVICE(name, arguments, results, effects, doc) \
    case Service::name:                                 \
        return name.call;
#define STRING_SERVICE(name, arguments, results, effects, doc) \
    case Service::name:                                        \
        return string_service(service);
#include "rsl/model/services.def"
    }
    return nullptr;
}

jit::ServiceFn find_service(const ServiceTable& table, std::string_view name) {
    if (std::optional<Service> service = find_service(name)) return table[*service];
    check_failed("rsl/model/service_table.cpp", 0, "unknown service " + std::string(name));
}

}  // namespace kinora::rsl
