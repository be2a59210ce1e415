// runtime/player/pixel/recorded_calls.cpp: questions and recorded calls, by their arguments.
#include "runtime/player/pixel/recorded_calls.h"

#include <algorithm>
#include <cmath>

namespace kinora {

namespace {

using rsl::Service;

// Rounding and the reference's own arithmetic move arguments so far, as shares of their size.
constexpr double kNear = 2e-3;

bool shoots_rays(Service service) {
    return service == Service::trace || service == Service::transmission ||
           service == Service::occlusion || service == Service::indirectdiffuse ||
           service == Service::gather || service == Service::samplinglights;
}

// Whether each call of the kernel answers one of the reference's.
bool is_used_up(Service service) {
    return shoots_rays(service) || service == Service::stratified;
}

// Arguments that the reference does not know: seeds, places in sequences, and the number of a
// gather.
bool is_open(Service service, const rsl::ServiceValue& value) {
    return value.name == "seed" || service == Service::stratified || value.name == "point" ||
           (service == Service::gather && (value.name == "request" || value.name == "level"));
}

// How far two lists of arguments are apart, of those that both have; above kNear: not the same.
double distance(Service service, std::span<const double> a, std::span<const double> b) {
    double most = 0;
    rsl::for_each_service_value(
        rsl::service_form(service).arguments, [&](const rsl::ServiceValue& value) {
            size_t first = size_t(value.first), width = size_t(value.width());
            if (is_open(service, value) || first + width > std::min(a.size(), b.size())) return;
            double size = 1e-30, apart = 0;
            for (size_t k = first; k < first + width; ++k) {
                size = std::max({size, std::fabs(a[k]), std::fabs(b[k])});
                bool both_nan = std::isnan(a[k]) && std::isnan(b[k]);
                apart = std::max(apart, both_nan ? 0.0 : std::fabs(a[k] - b[k]));
            }
            if (value.kind == 'i')
                most = std::max(most, apart == 0 ? 0.0 : 1.0);
            else
                most = std::max(most, value.is_spatial() ? apart / size : apart / (size + 1e-3));
        });
    return most;
}

}  // namespace

std::vector<double> RecordedCalls::answer(Service service, std::span<const double> arguments) {
    RecordedCall* best = nullptr;
    RecordedCall* alike = nullptr;  // of the same service, however far
    double best_distance = kNear, alike_distance = INFINITY;
    for (RecordedCall& call : calls_) {
        if (call.service != service) continue;
        double apart = distance(service, call.arguments, arguments);
        if (apart < alike_distance) alike = &call, alike_distance = apart;
        // Of those that are as near, the first that was not used yet.
        bool nearer = apart < best_distance - 1e-9 ||
                      (best && best->used && !call.used && apart <= best_distance + 1e-9);
        if ((best || apart <= kNear) && (nearer || !best)) best = &call, best_distance = apart;
    }
    if (best) {
        best->used = is_used_up(service);
        return best->results;
    }
    if (shoots_rays(service)) {
        unanswered_.insert(std::string(rsl::service_name(service)));
        return {};
    }
    // As the kernel would have asked it: with the filter of the call that is most alike.
    std::vector<double> all(size_t(rsl::argument_count(service)), 0.0);
    if (alike) std::copy(alike->arguments.begin(), alike->arguments.end(), all.begin());
    std::copy_n(arguments.begin(), std::min(arguments.size(), all.size()), all.begin());
    return live_(service, all);
}

void RecordedCalls::begin_run() {
    for (RecordedCall& call : calls_) call.used = false;
}

}  // namespace kinora
