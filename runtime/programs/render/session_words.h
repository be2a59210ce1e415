// runtime/programs/render/session_words.h: options as words: what a session keeps, and what it
// gives.
#pragma once

#include <string>
#include <vector>

#include "runtime/programs/common/command_line.h"
#include "runtime/programs/render/options.h"

namespace kinora {

// What was given of these options: "--spp=4", "-Ifolder", "--confine", a word each.
std::vector<std::string> given_words(const std::vector<const CLI::Option*>& options);

// Puts the options of the session among the words, if they name one by `--session FILE` or by a
// word that ends in .kinora, and the rest of it into `o`. An error text, or "".
std::string read_session_of(std::vector<std::string>& words, RenderOptions& o);

}  // namespace kinora
