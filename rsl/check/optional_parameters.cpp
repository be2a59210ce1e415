// rsl/check/optional_parameters.cpp: the types of "name", value pairs.
#include "rsl/check/optional_parameters.h"

#include "rsl/check/convert.h"
#include "rsl/model/pairs.h"

namespace kinora::rsl {

void drop_unfit_pairs(Ast& ast, TreeReporter& reporter, std::span<Expr*>& args, size_t first,
                      std::string_view callee) {
    size_t kept = first;
    for (size_t k = first; k + 1 < args.size(); k += 2) {
        Expr*& given = args[k + 1];
        if (given->type.base == BaseType::Bool) convert(ast, given, BaseType::Float);
        std::string_view name = pair_name(args, k + 1);
        BaseType wanted = option_type(name);
        bool known = wanted != BaseType::Invalid && given->type.base != BaseType::Invalid;
        if (known && given->type != Type{wanted, -1}) {
            reporter.report(Code::RSL_PAIR_TYPE, given->span, name, callee, type_name({wanted, -1}),
                            type_name(given->type));
            continue;
        }
        args[kept++] = args[k];
        args[kept++] = given;
    }
    args = args.first(kept);
}

}  // namespace kinora::rsl
