// rsl/compile_p.h: the end of the front end, which a source and linked sources share.
#pragma once

#include <memory>
#include <vector>

#include "rsl/model/shader.h"
#include "rsl/objects/units.h"
#include "rsl/syntax/parser.h"
#include "rsl/text/compile_options.h"
#include "rsl/text/reporter.h"

namespace kinora::rsl {

// Of classes that have displacement(), what is compiled.
enum class ClassForm { Whole, OnlyDisplacement };

// What is left to do for a tree, whose parts have been read. Empty after an error.
std::vector<std::unique_ptr<Shader>> finish_compiling(const std::shared_ptr<Ast>& ast,
                                                      Reporter& reporter,
                                                      const CompileOptions& options,
                                                      const ParseRecovery& recovery,
                                                      std::vector<Unit> units,
                                                      ClassForm form = ClassForm::Whole);

}  // namespace kinora::rsl
