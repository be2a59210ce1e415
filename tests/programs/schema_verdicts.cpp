// tests/programs/schema_verdicts.cpp: for schema_agreement_test.py: the XSD that the element table
// prints, and what the table says of each file named on standard input.
//   schema_verdicts print 1.4.1|1.5     the XSD
//   schema_verdicts check               "valid PATH" or "invalid PATH CODE...", tabs between
//   schema_verdicts time N FILE...      seconds of read_document and of check_elements, N times
#include <chrono>
#include <cstdio>
#include <iostream>

#include "collada/document/findings.h"
#include "collada/schema/schema.h"

namespace {

using namespace kinora;
using namespace kinora::collada;

// What --profile strict --only XML_,DOC_,SCHEMA_,ID_ makes errors: what an XSD could refuse.
bool is_departure(std::string_view code) {
    for (const FindingInfo* none :
         {&Code::DOC_OLD_VERSION, &Code::SCHEMA_FOREIGN, &Code::ID_BAD_CHAR})
        if (code == none->code) return false;
    for (std::string_view group : {"XML_", "DOC_", "SCHEMA_", "ID_"})
        if (code.starts_with(group)) return true;
    return false;
}

void check(const std::string& path) {
    Diagnostics diag;
    if (std::optional<Document> document = read_document(path, diag))
        check_elements(*document, diag);
    std::string codes;
    for (const Finding& f : diag.findings())
        if (is_departure(f.info->code)) codes += std::string("\t") + f.info->code;
    std::printf("%s\t%s%s\n", codes.empty() ? "valid" : "invalid", path.c_str(), codes.c_str());
}

int measure(int times, std::vector<std::string> files) {
    using Clock = std::chrono::steady_clock;
    std::chrono::duration<double> reading{}, checking{};
    size_t bytes = 0;
    for (int i = 0; i < times; ++i) {
        for (const std::string& path : files) {
            auto start = Clock::now();
            Diagnostics diag;
            std::optional<Document> document = read_document(path, diag);
            auto read = Clock::now();
            if (document) check_elements(*document, diag);
            checking += Clock::now() - read;
            reading += read - start;
            if (document) bytes += diag.files.text(document->file()).size();
        }
    }
    double all = reading.count() + checking.count();
    std::printf("%zu files, %.1f MB: read %.3f s, check %.3f s; %.0f files/s, %.0f MB/s\n",
                files.size() * size_t(times), double(bytes) / 1e6, reading.count(),
                checking.count(), double(files.size()) * times / all, double(bytes) / 1e6 / all);
    return 0;
}

}  // namespace

int main(int count, char** words) {
    std::string_view verb = count > 1 ? words[1] : "";
    if (verb == "print" && count == 3) {
        bool is_15 = std::string_view(words[2]) == "1.5";
        std::fputs(print_schema(is_15 ? Version::V1_5_0 : Version::V1_4_1).c_str(), stdout);
        return 0;
    }
    if (verb == "time" && count > 3)
        return measure(std::stoi(words[2]), std::vector<std::string>(words + 3, words + count));
    if (verb != "check") return 2;
    for (std::string path; std::getline(std::cin, path);) check(path);
    return 0;
}
