// collada/text/number_run.h: numbers in a text of which they are a part, as fast as those of a
// list.
#pragma once

#include <cstdint>
#include <vector>

namespace kinora::collada {

// Appends the numbers that stand from `p` on, parted by white space or by nothing, and returns
// where the first word begins that is none; that may be before white space. `begin` is where the
// text begins, which is looked at before `p`. Numbers that are not finite end the run.
const char* append_floats(const char* begin, const char* p, const char* end,
                          std::vector<float>& values);
// The same of whole numbers of 32 bits; others end the run.
const char* append_ints(const char* begin, const char* p, const char* end,
                        std::vector<int32_t>& values);
// The number at `p`, of any size: `value` is infinite where a double does not hold it. Returns its
// end; null: there is none.
const char* scan_number(const char* p, const char* end, double& value);

}  // namespace kinora::collada
