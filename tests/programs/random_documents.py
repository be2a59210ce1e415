"""tests/programs/random_documents.py: documents that a schema allows, and damaged copies of them.

The schemas are Debian's own, read as scripts/collada_table reads them; nothing here looks at our
table."""
import copy
import importlib.machinery
import importlib.util
import re
import xml.etree.ElementTree as ET

XSI = "http://www.w3.org/2001/XMLSchema-instance"
URI = {"V14": "http://www.collada.org/2005/11/COLLADASchema",
       "V15": "http://www.collada.org/2008/03/COLLADASchema"}
MATHML = "http://www.w3.org/1998/Math/MathML"
WORDS = {"string": "some text", "token": "a token", "NCName": "name", "Name": "a:name",
         "NMTOKEN": "1word", "anyURI": "a/b%20c.png#d", "boolean": "true", "double": "-1.5e3",
         "float": ".25", "integer": "-12345678901234567890123", "nonNegativeInteger": "+4",
         "positiveInteger": "3", "long": "-42", "int": "-7", "short": "-300", "byte": "-5",
         "unsignedLong": "18446744073709551615", "unsignedInt": "4294967295",
         "unsignedByte": "255", "dateTime": "2008-02-29T23:59:59.5+02:00", "hexBinary": "0aFF",
         "IDREF": "some_id", "fragment": "#some_id", "sidref": "./a/b(1)(2)",
         "email": "a.b@c.org", "%anything": ""}
ENOUGH = 400  # elements; then the rest of a document is as small as it may be


def load_table(source):
    path = str(source / "scripts/collada_table")
    loader = importlib.machinery.SourceFileLoader("collada_table", path)
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("collada_table", loader))
    loader.exec_module(module)
    return module


class Writer:
    """Writes random documents of one version, each led by types that none had before."""

    def __init__(self, table, version, random):
        self.random = random
        self.version = version
        self.rows = {}
        self.schema = table.Schema(version, table.SCHEMAS[version], self.rows)
        self.used = {}
        self.cost = {}
        self.ids = 0
        for _ in range(60):  # to the fixed point: how deep the least document of a type is
            for key, t in self.schema.types.items():
                self.cost[key] = 1 + self.least(t.content)

    def least(self, content):
        if not content:
            return 0
        if content[0] == "group":
            return self.least(self.schema.groups[content[1]]) if content[2] else 0
        if content[-2] == 0:
            return 0
        if content[0] == "element":
            return self.cost.get(content[2], 1 if content[2][0] == "simple" else 1000)
        costs = [self.least(part) for part in content[1]]
        return max(costs) if content[0] == "sequence" else min(costs)

    def document(self):
        self.ids = self.size = 0
        unused = [key for key in self.schema.types if key not in self.used]
        self.hope = set(unused[-1:] + self.random.sample(unused, min(len(unused), 8)))
        size = -1
        while size != len(self.hope):  # and what leads to them
            size = len(self.hope)
            self.hope |= {key for key, t in self.schema.types.items() if self.leads(t.content)}
        return self.element("COLLADA", self.schema.globals["COLLADA"], 0)

    def leads(self, content):
        """Is there a type in it that was never used?"""
        if not content:
            return False
        if content[0] == "element":
            return content[2] in self.hope
        if content[0] == "group":
            return self.leads(self.schema.groups[content[1]])
        return any(map(self.leads, content[1]))

    def element(self, name, key, depth):
        self.used[key] = self.used.get(key, 0) + 1
        self.size += 1
        if self.size > ENOUGH:
            self.hope.clear()
        out = ET.Element(f"{{{URI[self.version]}}}{name}")
        if key[0] == "simple":
            out.text = self.value(key[1])
            return out
        t = self.schema.types[key]
        for attribute, simple, required, default in t.attributes:
            if attribute == "xml:base" or not (required or self.random.random() < 0.4):
                continue
            out.set(attribute, default if default and self.random.random() < 0.3
                    else self.value(simple))
        if t.text and not (t.default and self.random.random() < 0.3):
            out.text = self.value(t.text)
        self.fill(out, t.content, depth)
        return out

    def fill(self, parent, content, depth):
        if not content:
            return
        low, high = content[-2:]
        most = low + 2 if high is None else high
        free = depth < 12 and self.size < ENOUGH and self.random.random() < 0.3
        count = self.random.randint(low, min(most, low + 2)) if free else low
        if self.leads(content) and depth < 14:
            repeats = high is None and content[0] in ("choice", "group")
            count = max(count, min(most, 4 if repeats else 1))
        for _ in range(count):
            self.fill_once(parent, content, depth)

    def fill_once(self, parent, content, depth):
        if content[0] == "group":
            self.fill(parent, self.schema.groups[content[1]], depth)
        elif content[0] == "sequence":
            for part in content[1]:
                self.fill(parent, part, depth)
        elif content[0] == "choice":
            self.fill(parent, self.choose(content[1], depth), depth)
        elif content[1] == "%any":
            parent.append(ET.Element("{urn:other}thing", {"id": "1 free"}))
        elif content[1] == "%math":
            parent.append(ET.Element(f"{{{MATHML}}}math"))
        else:
            parent.append(self.element(content[1], content[2], depth + 1))

    def choose(self, parts, depth):
        if depth > 10 or self.size > ENOUGH:
            return min(parts, key=self.least)
        parts = [p for p in parts if self.leads(p)] or list(parts)

        def uses(part):
            if part[0] == "element":
                return self.used.get(part[2], 0)
            inner = [self.schema.groups[part[1]]] if part[0] == "group" else part[1]
            return min(map(uses, inner)) if inner else 0

        self.random.shuffle(parts)
        return min(parts, key=uses)

    def value(self, simple):
        if simple == "ID":
            self.ids += 1
            return f"id{self.ids}"
        name, _, count = simple.partition("[")
        if count:
            many = int(count[:-1]) if count[:-1] else self.random.randint(0, 3)
            return " ".join(self.value(name) for _ in range(many)).replace("a token", "token")
        base, facets = self.rows.get((name, self.version), (name, ""))
        if ".." in facets:
            return self.random.choice([f for f in facets.split("..") if f])
        return self.random.choice(facets.split()) if facets else WORDS[base]


def local(element):
    return element.tag.split("}")[-1]


def damaged(root, names, random):
    """A copy with one change at a random place, and a word for the kind of change."""
    root = copy.deepcopy(root)
    parents = [p for p in root.iter() if len(p) and p.tag.startswith("{http://www.collada")]
    parent = random.choice(parents)
    at = random.randrange(len(parent))
    child = parent[at]
    kind = random.choice(["drop", "double", "swap", "rename", "insert", "text", "number", "attribute",
                          "no attribute", "value", "empty", "mixed", "move"])
    if kind == "drop":
        parent.remove(child)
    elif kind == "double":
        twin = copy.deepcopy(child)
        for e in twin.iter():
            e.attrib.pop("id", None) if random.random() < 0.5 else None
        parent.insert(at + 1, twin)
    elif kind == "swap":
        other = random.randrange(len(parent))
        parent[at], parent[other] = parent[other], parent[at]
    elif kind == "rename":
        child.tag = child.tag.replace(local(child), random.choice(names))
    elif kind == "insert":
        parent.insert(at, ET.Element(child.tag.replace(local(child), random.choice(names))))
    elif kind == "text":
        child.text = random.choice(["", " ", "x", "1", "1 2 3", "A_ONE", "true"])
    elif kind == "number":
        words = (child.text or "").split() or ["1"]
        words[random.randrange(len(words))] = random.choice(
            ["1,5", "-1", "1.", ".", "+1", "++1", "NaN", "-INF", "1e5", "0x1", "99999999999999999999",
             "-9223372036854775808", "1.5", "word", "", "#x"])
        child.text = " ".join(words)
    elif kind == "attribute":
        child.set(random.choice(["id", "name", "sid", "url", "count", "type", "bogus", "source"]),
                  random.choice(["a", "1", "a b", "#a", "http://[", "", "\u00e4", "id1"]))
    elif kind == "no attribute" and child.attrib:
        del child.attrib[random.choice(list(child.attrib))]
    elif kind == "value" and child.attrib:
        child.set(random.choice(list(child.attrib)),
                  random.choice(["", " ", "a b", "1", "-1", "x", "a%b", "true", "#a#b", "NODE"]))
    elif kind == "empty":
        for c in list(child):
            child.remove(c)
        child.text = None
    elif kind == "mixed":
        child.tail = "stray"
    elif kind == "move":
        parent.remove(child)
        random.choice(parents).append(child)
    return root, kind


def write(root, path):
    for prefix, uri in (("", URI["V14"] if URI["V14"] in root.tag else URI["V15"]),
                        ("xsi", XSI), ("o", "urn:other"), ("m", MATHML)):
        ET.register_namespace(prefix, uri)
    ET.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)


def namespace_version(text):
    """Which schema a file of this text is held against."""
    found = re.search(r'<(?:\w+:)?COLLADA[^>]*\sversion\s*=\s*["\'](1\.[45])', text)
    return "V15" if found and found[1] == "1.5" else "V14"
