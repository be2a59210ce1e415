// runtime/player/pixel/point_recorder.cpp: stand-ins for services, which note what they were asked.
#include "runtime/player/pixel/point_recorder.h"

#include <algorithm>
#include <utility>

#include "jit/ir/kernel_call.h"
#include "runtime/picture/shading/grid.h"
#include "runtime/player/pixel/point_inputs.h"
#include "runtime/scene/kernels/kernel_host.h"
#include "runtime/scene/kernels/kernel_probe.h"
#include "runtime/scene/shaders/scene_host.h"

namespace kinora {

namespace {

using rsl::Service;

thread_local PointRecorder* t_points = nullptr;

jit::ServiceFn service_of(Service service) {
    return find_service(rsl::service_name(service));
}

template <size_t k>
void stand_in(const jit::ServiceCall& call) {
    service_of(rsl::kServices[k])(call);
    if (t_points) t_points->note(rsl::kServices[k], call);
}

template <size_t... k>
constexpr std::array<jit::ServiceFn, sizeof...(k)> stand_ins(std::index_sequence<k...>) {
    return {stand_in<k>...};
}
constexpr auto kStandIns = stand_ins(std::make_index_sequence<rsl::kServiceCount>());

// Lane 0 of the rows of a call; ints as numbers.
std::vector<double> numbers(std::string_view list, const float* rows) {
    std::vector<double> out;
    rsl::for_each_service_value(list, [&](const rsl::ServiceValue& value) {
        for (int k = value.first; k < value.first + value.width(); ++k) {
            float x = rows[k * jit::kMaxLanes];
            out.push_back(value.kind == 'i' ? double(jit::bits_of(x)) : double(x));
        }
    });
    return out;
}

// As Reference::gather takes them: the number of rays, for each its state and results.
std::vector<double> gathered(const Grid& grid, const std::vector<double>& arguments,
                             int32_t handle) {
    const jit::RecordSet& set = grid.record_sets[size_t(handle)];
    size_t request = size_t(arguments[2]), width = 0;
    if (request < grid.look->lowered.gathers.size())
        for (const auto& result : grid.look->lowered.gathers[request])
            width += size_t(rsl::component_count(result.type));
    std::vector<double> rays = {double(set.count)};
    for (int32_t r = 0; r < set.count; ++r) {
        const float* const* columns = set.records[r].columns;
        rays.push_back(double(jit::bits_of(columns[rsl::kGatherState][0])));
        for (size_t k = 0; k < width; ++k)
            rays.push_back(double(columns[rsl::kGatherResults + k][0]));
    }
    return rays;
}

// The service itself, at one point.
std::vector<double> ask(KernelHost& host, Service service, std::span<const double> arguments) {
    const rsl::ServiceForm& form = rsl::service_form(service);
    std::vector<float> in((size_t(rsl::argument_count(service)) + 1) * jit::kMaxLanes);
    std::vector<float> out((size_t(rsl::result_count(service)) + 1) * jit::kMaxLanes);
    rsl::for_each_service_value(form.arguments, [&](const rsl::ServiceValue& value) {
        for (int k = value.first; k < value.first + value.width(); ++k) {
            double x = size_t(k) < arguments.size() ? arguments[size_t(k)] : 0;
            in[size_t(k) * jit::kMaxLanes] =
                value.kind == 'i' ? jit::float_of(int32_t(x)) : float(x);
        }
    });
    service_of(service)({&host, in.data(), out.data(), 1, 0, 1});
    return numbers(form.results, out.data());
}

}  // namespace

void watch_launches() {
    // Never taken away: other threads run kernels meanwhile.
    struct Launches final : KernelProbe {
        void run(const jit::KernelCall& call) override {
            if (t_points)
                t_points->run(call);
            else
                call.run();
        }
    };
    static Launches launches;
    static const bool watched = (probe_kernels(&launches), true);
    static_cast<void>(watched);
}

PointRecorder::PointRecorder(std::function<void(RecordedPoint&)> found) : found_(std::move(found)) {
    watch_launches();
    t_points = this;
}

PointRecorder::~PointRecorder() {
    t_points = nullptr;
}

void PointRecorder::run(const jit::KernelCall& call) {
    // No NotingHost, whose kernel runs again.
    auto* host = dynamic_cast<GridHost*>(static_cast<KernelHost*>(call.host));
    const Grid* grid = host ? &host->grid() : nullptr;
    bool seen = grid && grid->depth == 0 && grid->count() == 1 &&
                grid->look->kind == ShaderInstanceKind::Surface &&
                &call.kernel == &grid->look->full.kernel();
    if (!seen) return call.run();
    RecordedCalls calls([host](Service service, std::span<const double> arguments) {
        return ask(*host, service, arguments);
    });
    RecordedPoint point{*host, call, calls, {}};
    std::vector<jit::ServiceFn> services(call.services.begin(), call.services.end());
    for (size_t s = 0; s < services.size(); ++s)
        if (auto service = rsl::find_service(call.kernel.services[s].name))
            services[s] = kStandIns[size_t(*service)];
    jit::KernelCall watched = call;
    watched.services = services;
    host_ = host, point_ = &point;
    watched.run();
    host_ = nullptr, point_ = nullptr;
    found_(point);
}

void PointRecorder::note(Service service, const jit::ServiceCall& call) {
    if (!point_ || call.grid != static_cast<KernelHost*>(const_cast<GridHost*>(host_)) ||
        (call.mask & 1) == 0)
        return;
    const rsl::ServiceForm& form = rsl::service_form(service);
    RecordedCall noted{service, numbers(form.arguments, call.args),
                       numbers(form.results, call.results)};
    if (service == Service::lights) {
        const auto& P = noted.arguments;
        point_->lights_at.push_back(
            {{P[0], P[1], P[2]},
             point_lights(*host_, host_->grid().record_sets[size_t(noted.results[0])])});
        return;
    }
    if (service == Service::samplinglights) {
        const auto& set = host_->grid().record_sets[size_t(noted.results[0])];
        noted.results[0] = double(point_->sampled.size());
        point_->sampled.push_back(point_lights(*host_, set));
    }
    if (service == Service::gather)
        noted.results = gathered(host_->grid(), noted.arguments, int32_t(noted.results[0]));
    point_->calls.add(std::move(noted));
}

}  // namespace kinora
