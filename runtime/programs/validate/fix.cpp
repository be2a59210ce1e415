// runtime/programs/validate/fix.cpp: files repaired, as text, as a diff or in place.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "collada/document/archive.h"
#include "collada/validate/fix.h"
#include "runtime/base/files/temporary_file.h"
#include "runtime/base/regular_file.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/validate/kinora_validate.h"
#include "runtime/programs/validate/output_file.h"
#include "runtime/programs/validate/report.h"
#include "runtime/programs/validate/unified_diff.h"

namespace kinora {

namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool is_wanted(const FindingInfo& info, const void* context) {
    const auto& settings = *static_cast<const ValidateSettings*>(context);
    return settings.only.empty() ||
           std::any_of(settings.only.begin(), settings.only.end(), [&](const std::string& prefix) {
               return std::string_view(info.code).starts_with(prefix);
           });
}

std::optional<std::string> read_bytes(const std::string& file) {
    if (file == "-") return read_stdin();
    return read_regular_file(file);
}

std::string fixes_text(const collada::FixResult& fixed) {
    std::string text;
    for (const collada::FixCount& fix : fixed.fixes)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", fix.count, fix.info->code);
    if (text.empty()) return "nothing to repair";
    return "repaired " + text + (fixed.recoded.empty() ? "" : "; it is UTF-8 now");
}

// Repairs one file and writes what was asked for to `out` or the file itself.
class FileFix {
  public:
    FileFix(const ValidateSettings& settings, OutputFile& out) : settings_(settings), out_(out) {}

    bool wrote() const { return wrote_; }  // to `out`, if only that there is nothing to change

    int run(const std::string& file) {
        name_ = file == "-" ? "<stdin>" : file;
        // What cannot be repaired is reported as without --fix.
        std::optional<std::string> bytes = read_bytes(file);
        if (!bytes || bytes->empty())
            return report(validate_file(file, settings_, bytes.value_or("")));
        if (collada::is_archive_bytes(*bytes)) {
            say("an archive is not repaired: unpack it, repair its .dae and pack it again");
            return std::max(int(kExitSomeFailed), report(validate_file(file, settings_, *bytes)));
        }
        bool marked = bytes->starts_with(kByteOrderMark);
        std::string text = marked ? bytes->substr(kByteOrderMark.size()) : *bytes;
        collada::FixResult fixed =
            collada::fix_text(name_, text, settings_.validate, is_wanted, &settings_);
        std::string whole = (marked ? std::string(kByteOrderMark) : std::string()) + fixed.text;
        if (int code = write(file, *bytes, whole, fixed.recoded)) return code;
        say(fixes_text(fixed));
        return report(validate_text(name_, std::move(fixed.text), settings_));
    }

  private:
    // `recoded`: what `before` says in UTF-8, if it is none.
    int write(const std::string& file, const std::string& before, const std::string& after,
              const std::string& recoded) {
        wrote_ = !settings_.in_place;
        if (settings_.diff) {
            out_.write(unified_diff(recoded.empty() ? before : recoded, after, name_, name_));
        } else if (!settings_.in_place) {
            out_.write(after);
        } else if (before != after) {
            if (int error = replace_file(file, after)) {
                fmt::print(stderr, "kinora-validate: cannot write '{}': {}\n", file,
                           std::strerror(error));
                return kExitUnwritable;
            }
        }
        return kExitOk;
    }

    void say(const std::string& what) const {
        if (!settings_.quiet) fmt::print(stderr, "{}: {}\n", name_, what);
    }

    // What is left goes to stderr: stdout is the text or the diff.
    int report(const FileResult& result) const {
        bool shown = settings_.verbose || result.at_least(settings_.fail_on) > 0;
        if (shown && !settings_.quiet)
            std::fputs(kTextReport.file(result, settings_).c_str(), stderr);
        ValidateTotals totals;
        totals.add(result, settings_);
        return totals.exit_code();
    }

    const ValidateSettings& settings_;
    OutputFile& out_;
    std::string name_;
    bool wrote_ = false;
};

}  // namespace

int fix_batch(const ValidateSettings& settings, const std::vector<std::string>& files) {
    bool as_text = !settings.diff && !settings.in_place;
    if (as_text && files.size() != 1) {
        std::fputs(
            "kinora-validate: --fix alone writes one text; add --diff or --in-place for several "
            "files\n",
            stderr);
        return kExitUsage;
    }
    OutputFile out(settings.output);
    int worst = kExitOk;
    bool wrote = false;
    for (const std::string& file : files) {
        if (file == "-" && settings.in_place) {
            std::fputs("kinora-validate: --in-place cannot write to stdin\n", stderr);
            return kExitUsage;
        }
        FileFix fix(settings, out);
        worst = std::max(worst, fix.run(file));
        wrote = wrote || fix.wrote();
    }
    // What nothing was written to stays as it was.
    if (wrote && !out.close()) return kExitUnwritable;
    return worst;
}

}  // namespace kinora
