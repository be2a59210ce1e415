// rsl/model/services.h: the services of services.def: their names, arguments and results.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace kinora::rsl {

enum class Service : uint8_t {
#define SERVICE(name, arguments, results, effects, doc) name,
#include "rsl/model/services.def"
};

// One argument or result: `count` of a kind in a row. Its numbers begin at `first`.
struct ServiceValue {
    std::string_view name;
    char kind = 'f';
    int count = 1;
    int first = 0;

    constexpr bool is_spatial() const { return kind == 'p' || kind == 'v' || kind == 'n'; }
    constexpr int width() const { return count * (is_spatial() || kind == 'c' ? 3 : 1); }
};

struct ServiceForm {
    std::string_view name;
    std::string_view arguments, results;  // lists of values, as services.def has them
    bool pure;                            // same arguments, same results, no effect
};

inline constexpr ServiceForm kServiceForms[] = {
#define SERVICE(name, arguments, results, effects, doc) \
    {#name, arguments, results, std::string_view(#effects) == "Pure"},
#include "rsl/model/services.def"
};
inline constexpr size_t kServiceCount = std::size(kServiceForms);

inline constexpr std::array<Service, kServiceCount> kServices = {
#define SERVICE(name, arguments, results, effects, doc) Service::name,
#include "rsl/model/services.def"
};

constexpr const ServiceForm& service_form(Service service) {
    return kServiceForms[size_t(service)];
}
constexpr std::string_view service_name(Service service) {
    return service_form(service).name;
}
std::optional<Service> find_service(std::string_view name);

// "name", "name:kind" or "name:kindcount".
constexpr ServiceValue service_value(std::string_view text, int first) {
    size_t colon = text.find(':');
    ServiceValue value{text.substr(0, colon), 'f', 1, first};
    if (colon == std::string_view::npos) return value;
    value.kind = text[colon + 1];
    if (colon + 2 == text.size()) return value;
    value.count = 0;
    for (char digit : text.substr(colon + 2)) value.count = value.count * 10 + (digit - '0');
    return value;
}

// body(value) for each value of a list; how many numbers they are.
template <class Body>
constexpr int for_each_service_value(std::string_view list, Body&& body) {
    int first = 0;
    while (!list.empty()) {
        size_t end = list.find(' ');
        ServiceValue value = service_value(list.substr(0, end), first);
        first += value.width();
        list = end == std::string_view::npos ? "" : list.substr(end + 1);
        body(value);
    }
    return first;
}

// Numbers that a service is given, and that it answers.
constexpr int argument_count(Service service) {
    return for_each_service_value(service_form(service).arguments, [](const ServiceValue&) {});
}
constexpr int result_count(Service service) {
    return for_each_service_value(service_form(service).results, [](const ServiceValue&) {});
}

// An argument by its name; one that the row does not have does not compile.
consteval ServiceValue service_argument(Service service, std::string_view name) {
    std::optional<ServiceValue> found;
    for_each_service_value(service_form(service).arguments, [&](const ServiceValue& value) {
        if (value.name == name) found = value;
    });
    return found.value();
}

}  // namespace kinora::rsl
