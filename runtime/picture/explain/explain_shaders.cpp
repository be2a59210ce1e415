// runtime/picture/explain/explain_shaders.cpp: what each kernel computes and reads, and textures.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "jit/ir/kernel.h"
#include "rsl/model/kernel_keys.h"
#include "rsl/model/shader.h"
#include "runtime/picture/explain/explain_p.h"
#include "runtime/picture/shading/shading.h"
#include "runtime/scene/images/texture_store.h"
#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

namespace {

constexpr const char* kKindNames[] = {"surface", "light",        "volume",
                                      "imager",  "displacement", "transformation"};

// What a kernel reads at each point, each once: "P", "N by u and v".
struct PointInputs {
    std::set<std::string> values, partials;

    explicit PointInputs(const jit::Kernel& kernel) {
        for (const jit::InputInfo& input : kernel.inputs) {
            rsl::KernelKey key = rsl::key_of(input);
            if (input.rate != jit::Rate::Point) continue;
            if (key.kind == rsl::KeyKind::Global)
                (key.partial == rsl::Partial::None ? values : partials)
                    .insert(std::string(rsl::global_info(key.global()).name));
            else if (key.kind == rsl::KeyKind::Parameter)
                (key.partial == rsl::Partial::None ? values : partials).insert(rsl::name_of(key));
            else if (key.is_space())
                values.insert(fmt::format("space \"{}\"", rsl::name_of(key)));
        }
    }
};

std::string services_of(const jit::Kernel& kernel) {
    std::set<std::string> names;
    for (const jit::ServiceInfo& service : kernel.services) names.insert(service.name);
    return fmt::format("{}", fmt::join(names, " "));
}

// Of a class it is construct, begin, displacement and opacity; of others what Oi needs.
void explain_opacity(const ShaderInstance& look, const std::string& subject, ExplainedRows& rows) {
    const jit::Kernel& kernel = look.opacity->kernel();
    const std::string services = services_of(kernel);
    rows.add(subject, "a kernel of its own for shadow rays",
             fmt::format("Oi is computed at each point: {} of {} bytes of code, {}",
                         kernel.code_bytes, look.full.kernel().code_bytes,
                         services.empty() ? "no calls that remain" : "asks for " + services));
}

void explain_kernel(const ShaderInstance& look, ExplainedRows& rows) {
    const jit::Kernel& kernel = look.full.kernel();
    const std::string subject =
        fmt::format("{} ({} {})", look.name, kKindNames[size_t(look.kind)], look.shader().name);
    PointInputs inputs(kernel);
    rows.add(subject,
             inputs.values.empty()
                 ? std::string("reads no global")
                 : fmt::format("computed at each point: {}", fmt::join(inputs.values, " ")),
             fmt::format("{} inputs, {} bytes of {} code", kernel.inputs.size(), kernel.code_bytes,
                         kernel.target));
    if (inputs.partials.empty())
        rows.leave_out(subject, "no derivatives", "no value that needs one reaches a result");
    else
        rows.add(subject, fmt::format("derivatives of {}", fmt::join(inputs.partials, " ")),
                 "Du, Dv, area, calculatednormal or a filter width reads them");
    if (!kernel.services.empty())
        rows.add(subject, fmt::format("asks for {}", services_of(kernel)), "calls that remain");
    if (look.kind != ShaderInstanceKind::Surface) return;
    if (look.opacity)
        explain_opacity(look, subject, rows);
    else
        rows.leave_out(subject, "no kernel for shadow rays", "opaque everywhere");
}

std::string image_name(const StoredImage& image) {
    return image.path.substr(image.path.find_last_of('/') + 1);
}

}  // namespace

void explain_shaders(const Scene& scene, const Pose&, ExplainedRows& rows) {
    std::set<std::string> worn;
    for (const auto& look : scene.shader_instances) {
        worn.insert(look->name);
        if (!look->full.empty()) explain_kernel(*look, rows);
    }
    for (const auto& look : scene.vertex_instances)
        if (!look->full.empty()) explain_kernel(*look, rows);
    size_t unworn = 0;
    for (const MaterialDefinition& material : scene.description->materials)
        unworn += !worn.contains(material.id.empty() ? material.name : material.id);
    if (unworn)
        rows.leave_out(fmt::format("{} materials", unworn), "never compiled",
                       "no mesh that is shown wears them");
}

void explain_textures(const Scene& scene, const Pose&, ExplainedRows& rows) {
    if (!scene.textures) return;
    bool module = false;
    scene.textures->each_image([&](const StoredImage& image) {
        module |= image.by_module;
        if (image.error.empty())
            rows.add(image_name(image),
                     fmt::format("read: {} x {}", image.facts.width, image.facts.height),
                     "a shader that is worn names it");
        else
            rows.leave_out(image_name(image), "checks are shown", image.error);
    });
    if (scene.textures->images() == 0)
        rows.leave_out("images", "none is opened", "no shader that is worn names one");
    if (!module)
        rows.leave_out("OpenImageIO", "not loaded", "no picture needs it: PNG is read without");
}

}  // namespace kinora
