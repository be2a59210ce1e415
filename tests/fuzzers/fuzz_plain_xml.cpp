// tests/fuzzers/fuzz_plain_xml.cpp: what the fast reader accepts, expat accepts and sees alike.
#include "collada/document/document_reader_p.h"
#include "collada/document/plain_xml_p.h"
#include "tests/fuzzers/fuzzer.h"

using namespace kinora;
using namespace kinora::collada;

namespace {

bool same(ByteRange a, ByteRange b) {
    return a.begin == b.begin && a.end == b.end;
}

bool same(const Element& a, const Element& b) {
    bool equal = a.name == b.name && a.text == b.text && a.index == b.index &&
                 same(a.bytes, b.bytes) && same(a.start_tag, b.start_tag) &&
                 a.attributes.size() == b.attributes.size() &&
                 a.text_map.size() == b.text_map.size();
    for (size_t i = 0; equal && i < a.attributes.size(); ++i) {
        const Attribute &x = a.attributes[i], &y = b.attributes[i];
        equal = x.name == y.name && x.value == y.value && same(x.bytes, y.bytes) &&
                same(x.value_bytes, y.value_bytes);
    }
    for (size_t i = 0; equal && i < a.text_map.size(); ++i)
        equal = a.text_map[i].text_offset == b.text_map[i].text_offset &&
                a.text_map[i].file_offset == b.text_map[i].file_offset;
    const Element *x = a.first_child, *y = b.first_child;
    for (; equal && x && y; x = x->next, y = y->next) equal = same(*x, *y);
    return equal && !x && !y;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    Diagnostics diag;
    FileId file = diag.files.add("fuzz.dae", std::string(fuzz::text_of(data, size)));
    DocumentBuilder plain("fuzz.dae", file, diag.files.text(file));
    if (!read_plain_xml(diag.files.text(file), plain)) return 0;
    auto document = DocumentReader("fuzz.dae", file, diag).read_by_expat();
    bool refused = false, other_root = false;
    for (const Finding& finding : diag.findings()) {
        refused = refused || std::string_view(finding.info->code).starts_with("XML_");
        other_root =
            other_root || finding.info == &Code::DOC_ROOT || finding.info == &Code::DOC_TOO_OLD;
    }
    if (refused) fuzz::expect("expat accepts what the fast reader does");
    if (!document && !other_root) fuzz::expect("no document without an error");
    if (document && !same(*plain.root(), document->root())) fuzz::expect("both see the same");
    return 0;
}
