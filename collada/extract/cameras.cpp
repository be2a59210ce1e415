// collada/extract/cameras.cpp: perspective and orthographic cameras.
#include <cmath>

#include "collada/document/element_numbers_p.h"
#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

Slot read_slot(Extraction& x, Link link, uint32_t count, TargetRef ref) {
    const Element& e = *link.element;
    Slot slot;
    slot.sid = e.value("sid");
    slot.where = x.where(link);
    std::vector<double> numbers = read_doubles(x.document(link.doc), e, x.diag);
    if (numbers.empty()) return slot;
    slot.count = uint8_t(count);
    for (size_t i = 0; i < count && i < numbers.size(); ++i)
        slot.values[i] = std::isfinite(numbers[i]) ? numbers[i] : 0;
    ref.first = 0;
    ref.count = count;
    x.target_of[link.element] = ref;
    return slot;
}

namespace {

struct CameraRow {
    std::string_view name;
    CameraSlot slot;
};
constexpr CameraRow kCameraSlots[] = {{"xfov", CameraSlot::Xfov},
                                      {"yfov", CameraSlot::Yfov},
                                      {"xmag", CameraSlot::Xmag},
                                      {"ymag", CameraSlot::Ymag},
                                      {"znear", CameraSlot::Znear},
                                      {"zfar", CameraSlot::Zfar},
                                      {"aspect_ratio", CameraSlot::AspectRatio}};

void drop(Extraction& x, Camera& camera, CameraSlot slot, const char* what) {
    Slot& s = camera.slots[size_t(slot)];
    x.diag.report(Code::CAM_FOV, s.where, camera.id, fmt::format("{} is {}", what, s.values[0]));
    s.count = 0;
}

// Two of width, height and their ratio say all; a third may only repeat it.
void check_aspect(Extraction& x, const Camera& camera) {
    bool flat = camera.orthographic;
    const Slot& width = camera[flat ? CameraSlot::Xmag : CameraSlot::Xfov];
    const Slot& height = camera[flat ? CameraSlot::Ymag : CameraSlot::Yfov];
    const Slot& aspect = camera[CameraSlot::AspectRatio];
    if (!width.present() || !height.present() || !aspect.present()) return;
    auto size = [&](const Slot& s) {
        return flat ? s.values[0] : std::tan(s.values[0] * (3.14159265358979323846 / 360));
    };
    double ratio = size(width) / size(height);
    if (!(std::abs(ratio / aspect.values[0] - 1) > 0.02)) return;
    x.diag.report(Code::CAM_FOV, aspect.where, camera.id,
                  fmt::format("aspect_ratio {} contradicts the ratio {:.4g} of the other two",
                              aspect.values[0], ratio));
}

// Values that no picture can have; those that only look odd pass.
void check_camera(Extraction& x, Camera& camera) {
    bool dropped = false;
    auto check = [&](CameraSlot slot, const char* what, double below) {
        const Slot& s = camera[slot];
        if (!s.present() || (s.values[0] > 0 && s.values[0] < below)) return;
        drop(x, camera, slot, what);
        dropped = true;
    };
    for (CameraSlot slot : {CameraSlot::Xfov, CameraSlot::Yfov}) check(slot, "the angle", 180);
    for (CameraSlot slot : {CameraSlot::Xmag, CameraSlot::Ymag, CameraSlot::AspectRatio})
        check(slot, "the size", HUGE_VAL);
    check_aspect(x, camera);
    const Slot& near = camera[CameraSlot::Znear];
    const Slot& far = camera[CameraSlot::Zfar];
    if (near.present() && !camera.orthographic && !(near.values[0] > 0)) {
        x.diag.report(Code::CAM_Z, near.where, camera.id, near.values[0],
                      far.present() ? far.values[0] : 0);
        camera.slots[size_t(CameraSlot::Znear)].count = 0;
    }
    if (near.present() && far.present() && near.values[0] >= far.values[0]) {
        x.diag.report(Code::CAM_Z, near.where, camera.id, near.values[0], far.values[0]);
        camera.slots[size_t(CameraSlot::Znear)].count = 0;
        camera.slots[size_t(CameraSlot::Zfar)].count = 0;
    }
    CameraSlot a = camera.orthographic ? CameraSlot::Xmag : CameraSlot::Xfov;
    CameraSlot b = camera.orthographic ? CameraSlot::Ymag : CameraSlot::Yfov;
    if (!dropped && !camera[a].present() && !camera[b].present())
        x.diag.report(Code::CAM_FOV, camera.where, camera.id,
                      std::string(camera.orthographic ? "neither xmag nor ymag is given"
                                                      : "neither xfov nor yfov is given"));
}

}  // namespace

uint32_t camera_index(Extraction& x, Link link) {
    auto [at, fresh] = x.made.emplace(link.element, kNone);
    if (!fresh) return at->second;
    const Element& e = *link.element;
    if (!x.budget.reserve(sizeof(Camera), x.where(link))) return kNone;
    uint32_t number = uint32_t(x.scene.cameras.size());
    at->second = number;
    Camera camera;
    camera.id = e.value("id");
    camera.name = e.value("name");
    camera.where = x.where(link);
    const Element* optics = e.child("optics");
    const Element* common = optics ? optics->child("technique_common") : nullptr;
    const Element* kind = common ? common->child("perspective") : nullptr;
    if (common && !kind) {
        kind = common->child("orthographic");
        camera.orthographic = kind != nullptr;
    }
    for (const CameraRow& row : kCameraSlots)
        if (const Element* value = kind ? kind->child(row.name) : nullptr)
            camera.slots[size_t(row.slot)] =
                read_slot(x, {link.doc, value}, 1, {Owner::Camera, number, uint32_t(row.slot)});
    check_camera(x, camera);
    x.scene.cameras.push_back(std::move(camera));
    auto materials = rsl_extra_materials(x, link);
    x.scene.cameras[number].rsl_materials = std::move(materials);
    return number;
}

}  // namespace kinora::collada
