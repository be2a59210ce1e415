// collada/schema/print_schema.cpp: the element table as an XML Schema.
#include <map>

#include "collada/schema/element_types_p.h"
#include "collada/schema/schema.h"
#include "runtime/base/check.h"

namespace kinora::collada {

namespace {

std::string escaped(std::string_view text) {
    std::string out;
    for (char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

std::string attribute(std::string_view name, std::string_view value) {
    return " " + std::string(name) + "=\"" + escaped(value) + "\"";
}

// A facet or another empty element.
std::string leaf(std::string_view name, std::string_view key, std::string_view value) {
    return "<xs:" + std::string(name) + attribute(key, value) + "/>";
}

// "double[3]" -> "double.3", "double[]" -> "double.list": a name XSD allows.
std::string list_name(const SimpleType& type) {
    std::string name(type.cell.substr(0, type.cell.find('[')));
    return name + (type.length ? "." + std::to_string(type.length) : ".list");
}

class SchemaPrinter {
  public:
    explicit SchemaPrinter(Version version)
        : version_(version), types_(ElementTypes::of(version)) {}

    std::string print() {
        std::string body;
        for (const ContentRow& row : global_rows())
            if (holds_for(row.versions, version_))
                for (const Particle& part : parse_content(row.content).parts)
                    body += "  " + element(part) + "\n";
        for (const ContentRow& row : group_rows())
            if (holds_for(row.versions, version_)) body += group(row);
        for (const ElementRow& row : element_rows())
            if (holds_for(row.versions, version_)) body += complex_type(row);
        std::string_view uri = is_15(version_) ? "http://www.collada.org/2008/03/COLLADASchema"
                                               : "http://www.collada.org/2005/11/COLLADASchema";
        std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
        out += "<!-- COLLADA " + std::string(is_15(version_) ? "1.5.0" : "1.4.1") +
               " with profile_RSL, written by Kinora from its table of elements. -->\n";
        out += "<xs:schema xmlns:xs=\"http://www.w3.org/2001/XMLSchema\"" +
               attribute("xmlns", uri) + attribute("targetNamespace", uri) +
               " elementFormDefault=\"qualified\">\n";
        out += body;
        for (const auto& [name, text] : simple_) out += text;
        return out + "</xs:schema>\n";
    }

  private:
    // The name by which a simple type can be used; what it needs is written once.
    std::string simple(std::string_view cell) {
        SimpleType type = parse_simple(cell, version_);
        std::string item(cell.substr(0, cell.find('[')));
        std::string name = base_name(item, type);
        if (!type.list) return name;
        std::string key = list_name(type);
        std::string& text = simple_[key];
        if (!text.empty()) return key;
        text = "  <xs:simpleType name=\"" + key + "\">";
        std::string list = leaf("list", "itemType", name);
        if (type.length)
            text += "<xs:restriction><xs:simpleType>" + list + "</xs:simpleType>" +
                    leaf("length", "value", std::to_string(type.length)) + "</xs:restriction>";
        else
            text += list;
        text += "</xs:simpleType>\n";
        return key;
    }

    std::string base_name(const std::string& item, const SimpleType& type) {
        std::string base = "xs:" + std::string(type.base->name);
        if (!type.base->base.empty()) {
            base = type.base->name;
            simple_[base] = "  <xs:simpleType name=\"" + base + "\"><xs:restriction" +
                            attribute("base", "xs:" + std::string(type.base->base)) + ">" +
                            leaf("pattern", "value", type.base->pattern) +
                            "</xs:restriction></xs:simpleType>\n";
        }
        if (type.row.empty()) return base;
        std::string text = "  <xs:simpleType name=\"" + item + "\"><xs:restriction" +
                           attribute("base", base) + ">";
        for (std::string_view value : type.values) text += leaf("enumeration", "value", value);
        if (type.has_low) text += leaf("minInclusive", "value", fmt::format("{}", type.low));
        if (type.has_high) text += leaf("maxInclusive", "value", fmt::format("{}", type.high));
        simple_[item] = text + "</xs:restriction></xs:simpleType>\n";
        return item;
    }

    static std::string occurs(const Particle& p) {
        std::string out;
        if (p.low != 1) out += attribute("minOccurs", std::to_string(p.low));
        if (p.high == Particle::kMany)
            out += attribute("maxOccurs", "unbounded");
        else if (p.high != 1)
            out += attribute("maxOccurs", std::to_string(p.high));
        return out;
    }

    std::string element(const Particle& p) {
        std::string out = "<xs:element" + attribute("name", p.name);
        if (p.type == "=%anything") return out + occurs(p) + "/>";
        if (p.type.starts_with('='))
            return out + attribute("type", simple(p.type.substr(1))) + occurs(p) + "/>";
        // A text that may be missing is a default, which belongs to the element.
        const ElementRules& rules = types_.find(p.type)->rules();
        out += attribute("type", "T." + std::string(p.type));
        if (rules.has_default) out += attribute("default", rules.default_text);
        return out + occurs(p) + "/>";
    }

    std::string particle(const Particle& p, const std::string& indent) {
        switch (p.kind) {
            case Particle::Kind::Element:
                return indent + element(p) + "\n";
            case Particle::Kind::Any:
                return indent + "<xs:any namespace=\"##any\" processContents=\"lax\"" + occurs(p) +
                       "/>\n";
            case Particle::Kind::Math:
                return indent + "<xs:any namespace=\"http://www.w3.org/1998/Math/MathML\"" +
                       " processContents=\"skip\"" + occurs(p) + "/>\n";
            case Particle::Kind::Group:
                return indent + "<xs:group" + attribute("ref", "G." + std::string(p.name)) +
                       occurs(p) + "/>\n";
            case Particle::Kind::Sequence:
            case Particle::Kind::Choice:
                break;
        }
        std::string name = p.kind == Particle::Kind::Sequence ? "sequence" : "choice";
        std::string out = indent + "<xs:" + name + occurs(p) + ">\n";
        for (const Particle& part : p.parts) out += particle(part, indent + "  ");
        return out + indent + "</xs:" + name + ">\n";
    }

    // The model of a type or group: always a sequence or choice.
    std::string model(std::string_view cell, const std::string& indent) {
        Particle all = parse_content(cell);
        bool alone = all.parts.size() == 1 && (all.parts[0].kind == Particle::Kind::Choice ||
                                               all.parts[0].kind == Particle::Kind::Sequence);
        return particle(alone ? all.parts[0] : all, indent);
    }

    std::string group(const ContentRow& row) {
        return "  <xs:group" + attribute("name", "G." + std::string(row.name)) + ">\n" +
               model(row.content, "    ") + "  </xs:group>\n";
    }

    std::string attributes(const ElementRules& rules, const std::string& indent) {
        std::string out;
        for (const AttributeType& a : rules.attributes) {
            if (a.name.starts_with("xml:")) continue;  // by the wildcard below
            out += indent + "<xs:attribute" + attribute("name", a.name) +
                   attribute("type", simple(a.type.cell));
            if (a.required) out += attribute("use", "required");
            if (a.has_default && !a.required) out += attribute("default", a.default_value);
            out += "/>\n";
        }
        if (rules.foreign_xml)
            out += indent + "<xs:anyAttribute namespace=\"http://www.w3.org/XML/1998/namespace\"" +
                   " processContents=\"skip\"/>\n";
        return out;
    }

    std::string complex_type(const ElementRow& row) {
        const ElementRules& rules = types_.find(row.type)->rules();
        std::string out =
            "  <xs:complexType" + attribute("name", "T." + std::string(row.type)) + ">\n";
        if (rules.has_text)
            return out + "    <xs:simpleContent>\n      <xs:extension" +
                   attribute("base", simple(rules.text.cell)) + ">\n" +
                   attributes(rules, "        ") +
                   "      </xs:extension>\n    </xs:simpleContent>\n  </xs:complexType>\n";
        if (!row.content.empty()) out += model(row.content, "    ");
        return out + attributes(rules, "    ") + "  </xs:complexType>\n";
    }

    Version version_;
    const ElementTypes& types_;
    std::map<std::string, std::string> simple_;  // name -> its definition
};

}  // namespace

std::string print_schema(Version version) {
    return SchemaPrinter(version).print();
}

}  // namespace kinora::collada
