// collada/validate/lint_asset.cpp: what <asset> should say.
#include "collada/validate/lint_p.h"

namespace kinora::collada {

void lint_asset(Lint& lint) {
    const Element& root = lint.document.root();
    const Element* asset = root.child("asset");
    if (!asset || !asset->child("up_axis"))
        lint.diag.report(Code::UPAXIS_MISSING, lint.where(asset ? *asset : root));
}

}  // namespace kinora::collada
