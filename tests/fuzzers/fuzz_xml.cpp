// tests/fuzzers/fuzz_xml.cpp: any bytes as a document: encodings, XML, the element table.
#include "collada/document/document.h"
#include "tests/collada/scene_promises.h"
#include "tests/fuzzers/fuzzer.h"

using namespace kinora;

namespace {

// Every element lies within its parent, after its elder siblings.
bool well_nested(const collada::Element& element, size_t size) {
    if (element.bytes.end > size || element.start_tag.end > element.bytes.end) return false;
    uint32_t from = element.bytes.begin;
    for (const collada::Element& child : element.children()) {
        if (child.bytes.begin < from || child.bytes.end > element.bytes.end) return false;
        if (!well_nested(child, size)) return false;
        from = child.bytes.end;
    }
    return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    Diagnostics diag;
    fuzz::MemoryBound bound(size);
    auto document =
        collada::read_document_text("fuzz.dae", std::string(fuzz::text_of(data, size)), diag);
    if (document) {
        collada::check_elements(*document, diag);
        if (!well_nested(document->root(), diag.files.text(document->file()).size()))
            fuzz::expect("elements nest as their bytes do");
    } else if (!diag.has_errors()) {
        fuzz::expect("no document without an error");
    }
    fuzz::expect(collada::broken_place(diag));
    for (const Finding& f : diag.findings()) format_finding(f, diag.files);
    return 0;
}
