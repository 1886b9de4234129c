# SPDX-License-Identifier: MPL-2.0
"""Reads USD's text as far as the program writes it, and checks what usdchecker would."""

import re

TOKEN = re.compile(r'\s*("(?:\\.|[^"\\])*"|<[^<>]*>|[\w:.+-]+(?:\[\])?|[()\[\]{}=,])')


class Prim:
    """A prim: its words ("def", "Mesh"), metadata, properties {name: (type, value, metadata)}, children
    and variants {(set, variant): Prim}."""

    def __init__(self, kind, name, path, meta):
        self.kind, self.name, self.path, self.meta = kind, name, path, meta
        self.properties, self.children, self.variants = {}, {}, {}

    def value(self, name):
        return self.properties[name][1]

    def all(self):
        yield self
        for child in [*self.children.values(), *self.variants.values()]:
            yield from child.all()


class Reader:
    def __init__(self, text):
        assert text.startswith("#usda 1.0\n")
        self.tokens, at = [], len("#usda 1.0\n")
        text = text.rstrip()
        while at < len(text):
            found = TOKEN.match(text, at)
            assert found, text[at:at + 60]
            self.tokens.append(found[1])
            at = found.end()
        self.at = 0
        self.meta = self.metadata()
        self.roots = {}
        while self.at < len(self.tokens):
            prim = self.prim("")
            self.roots[prim.name] = prim

    def peek(self):
        return self.tokens[self.at] if self.at < len(self.tokens) else None

    def take(self, expected=None):
        token = self.tokens[self.at]
        assert expected is None or token == expected, f"{expected}: {self.tokens[self.at - 5:self.at + 5]}"
        self.at += 1
        return token

    def metadata(self):
        out = {}
        if self.peek() != "(":
            return out
        self.take("(")
        while self.peek() != ")":
            words = [self.take()]
            while self.peek() != "=":
                words.append(self.take())
            self.take("=")
            out[words[-1]] = self.any_value()
        self.take(")")
        return out

    def any_value(self):
        token = self.take()
        if token in "([":
            end, out = {"(": ")", "[": "]"}[token], []
            while self.peek() != end:
                out.append(self.any_value())
                if self.peek() == ",":
                    self.take()
            self.take(end)
            return out
        if token == "{":
            out = {}
            while self.peek() != "}":
                self.take()  # the type
                name = self.take()
                self.take("=")
                out[name] = self.any_value()
            self.take("}")
            return out
        return token[1:-1] if token[0] in '"<' else float(token)

    def prim(self, above):
        words = [self.take()]
        while not self.peek().startswith('"'):
            words.append(self.take())
        name = self.take()[1:-1]
        prim = Prim(words, name, f"{above}/{name}", self.metadata())
        self.body(prim)
        return prim

    def body(self, prim):
        self.take("{")
        while self.peek() != "}":
            if self.peek() in ("def", "over", "class"):
                child = self.prim(prim.path)
                assert child.name not in prim.children, child.path
                prim.children[child.name] = child
            elif self.peek() == "variantSet":
                self.take()
                kind = self.take()[1:-1]
                self.take("=")
                self.take("{")
                while self.peek() != "}":
                    variant = self.take()[1:-1]
                    inside = prim.variants[kind, variant] = Prim(["over"], prim.name, prim.path, {})
                    self.body(inside)
                self.take("}")
            else:
                words = [self.take()]
                while self.peek() == "uniform" or not re.search(r"[:\w]", words[-1]) or len(words) < (
                        3 if words[0] == "uniform" else 2):
                    words.append(self.take())
                value = None
                if self.peek() == "=":
                    self.take()
                    value = self.any_value()
                assert words[-1] not in prim.properties, words
                prim.properties[words[-1]] = (words[-2], value, self.metadata())
        self.take("}")


def read_usda(text):
    """(metadata of the file, prims of the root)."""
    reader = Reader(text)
    return reader.meta, reader.roots


def faults(text):
    """Lines on what is wrong, by the rules of src/molsurf/show/io/write_usda_instances.h."""
    meta, roots = read_usda(text)
    out = []

    def hold(condition, what):
        if not condition:
            out.append(what)

    hold(meta.get("defaultPrim") in roots, "defaultPrim")
    hold(meta.get("upAxis") in ("Y", "Z"), "upAxis")
    hold(meta.get("metersPerUnit", 0) > 0, "metersPerUnit")
    every = [prim for root in roots.values() for prim in root.all()]
    paths = {prim.path for prim in every}
    for prim in every:
        hold(re.fullmatch(r"[A-Za-z_]\w*", prim.name), f"name {prim.name}")
        for name, (_, value, _) in prim.properties.items():
            if name.endswith(".connect") or name == "material:binding" or name == "prototypes":
                for target in value if isinstance(value, list) else [value]:
                    hold(target.split(".")[0] in paths, f"{prim.path}.{name}: {target}")
        if "references" in prim.meta:
            hold(prim.meta["references"] in paths, f"{prim.path}: {prim.meta['references']}")
        if "material:binding" in prim.properties:
            hold("MaterialBindingAPI" in prim.meta.get("apiSchemas", []), f"{prim.path}: apiSchemas")
        ops = [name for name in prim.properties if name.startswith("xformOp:")]
        hold(not ops or prim.value("xformOpOrder") == ops, f"{prim.path}: xformOpOrder")
        if prim.kind == ["def", "Mesh"] and "points" in prim.properties:
            points, corners = prim.value("points"), prim.value("faceVertexIndices")
            low, high = prim.value("extent")
            hold(sum(prim.value("faceVertexCounts")) == len(corners), f"{prim.path}: faces")
            hold(0 <= min(corners) and max(corners) == len(points) - 1, f"{prim.path}: indices")
            hold(len(prim.value("normals")) == len(points), f"{prim.path}: normals")
            hold(all(abs(sum(x * x for x in n) - 1) < 1e-3 for n in prim.value("normals")),
                 f"{prim.path}: length of normals")
            hold(prim.value("subdivisionScheme") == "none", f"{prim.path}: subdivisionScheme")
            for i in range(3):
                hold(min(p[i] for p in points) == low[i] and max(p[i] for p in points) == high[i],
                     f"{prim.path}: extent")
        if prim.kind == ["def", "PointInstancer"]:
            count = len(prim.value("protoIndices"))
            for name in ("ids", "positions", "orientations", "orientationsf"):
                hold(len(prim.value(name)) == count, f"{prim.path}: {name}")
            shown = [prim] if "prototypes" in prim.properties else [
                variant.children[prim.name] for root in roots.values() for variant in root.variants.values()]
            for each in shown:
                hold(max(prim.value("protoIndices")) == len(each.value("prototypes")) - 1,
                     f"{prim.path}: protoIndices")
                hold(len(each.value("extent")) == 2, f"{prim.path}: extent")
    for root in roots.values():
        for kind, chosen in root.meta.get("variants", {}).items():
            hold((kind, chosen) in root.variants, f"variant {kind} {chosen}")
    return out
