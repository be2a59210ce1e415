// collada/validate/lint_textures.cpp: samplers written as the other version has them.
#include "collada/validate/lint_p.h"

namespace kinora::collada {

void lint_textures(Lint& lint) {
    if (lint.document.version() == Version::V1_5_0) {
        for (const Element* param : lint.named("newparam"))
            for (const Element& value : param->children()) {
                bool sampler = value.name.starts_with("sampler") && value.child("source");
                if (sampler || value.name == "surface")
                    lint.diag.report(Code::TEX_SURFACE_1_5, lint.where(value),
                                     sampler ? "<source> of a sampler" : "<surface>");
            }
        return;
    }
    for (const Element* instance : lint.named("instance_image"))
        if (instance->parent->name != "environment")  // which is our own (docs/format.md)
            lint.diag.report(Code::TEX_INSTANCE_IMAGE_1_4, lint.where(*instance));
}

}  // namespace kinora::collada
