// runtime/scene/tessellate/evaluate.cpp: one place of a surface.
#include "runtime/scene/tessellate/sheet_p.h"
#include "runtime/scene/tessellate/tessellate.h"

namespace kinora {

SurfacePoint evaluate(const CurvedSurface& surface, double u, double v) {
    using namespace tessellation;
    std::unique_ptr<Sheet> sheet = make_sheet(surface);
    if (!sheet) return {};
    Line a = sheet->u.locate(u), b = sheet->v.locate(v);
    Jet jet = sheet->jet(a, b);
    SurfacePoint point;
    point.p = jet.p;
    point.du = jet.u / sheet->u.parameter_rate(a);
    point.dv = jet.v / sheet->v.parameter_rate(b);
    if (!is_finite(point.p) || !is_finite(point.du) || !is_finite(point.dv)) return {};
    point.normal = unit_normal(*sheet, a, b);
    return point;
}

}  // namespace kinora
