// runtime/programs/play/headless.h: the player without a window.
#pragma once

#include <map>
#include <set>
#include <string>

#include "runtime/play/player.h"
#include "runtime/programs/play/options.h"

namespace kinora {

// Findings that were not printed yet, to stderr, as the options want them: 20 of a code.
class FindingLines {
  public:
    explicit FindingLines(const FindingOptions& options) : options_(options) {}
    void print(const Player& player);
    // How many there were beyond these.
    void summarize() const;
    // There were errors, or what --fail-on names.
    bool fails() const { return fails_; }
    bool lacks_assets() const { return options_.strict && missing_; }
    bool lacks_memory() const { return lacks_memory_; }

  private:
    FindingOptions options_;
    std::set<std::string> seen_;
    std::map<std::string, size_t> counts_;  // by code, of those to be printed
    bool fails_ = false, missing_ = false, lacks_memory_ = false;
};

// The script, then the screenshots. The program's exit code.
int run_headless(const PlayOptions& options, Player& player);

}  // namespace kinora
