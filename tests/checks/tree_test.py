#!/usr/bin/env python3
"""The checks on the tree must find what they are there to find."""

import os
import tempfile
import unittest

import tree


class Tree(unittest.TestCase):
    def findings(self, check, content, executable=()):
        with tempfile.TemporaryDirectory() as root:
            for name, text in content.items():
                file = os.path.join(root, name)
                os.makedirs(os.path.dirname(file), exist_ok=True)
                with open(file, "w", encoding="utf-8") as out:
                    out.write(text)
                if name in executable:
                    os.chmod(file, 0o755)
            return check(root)[0]

    def test_readmes(self):
        good = {"CMakeLists.txt": "", "README.md": "tools/demo tools/test [a](a)", "a/CMakeLists.txt": "", "a/README.md": ""}
        self.assertEqual(self.findings(tree.readmes, good), [])
        without = {name: text for name, text in good.items() if name != "a/README.md"}
        self.assertRegex(self.findings(tree.readmes, without)[0], "^a/README.md: missing")
        self.assertRegex(self.findings(tree.readmes, {"CMakeLists.txt": ""})[0], "^README.md: missing")
        self.assertEqual(
            self.findings(tree.readmes, good | {"README.md": "tools/demo [a](a/b.md) [c](https://example.org)"}),
            ["README.md: does not name tools/test", "README.md: dead link: a/b.md"],
        )

    def sizes(self, content, large=None):
        return self.findings(lambda root: tree.sizes(root, large or {}), content)

    def test_members(self):
        def with_members(count):
            body = "".join(f"    std::array<int, 2> m{i}_{{}};  ///< one\n" for i in range(count))
            return f"class A final : public B {{\n  public:\n    int get() const {{ return m0_; }}\n{body}}};\n"

        self.assertEqual(self.sizes({"a.h": with_members(20)}), [])
        self.assertRegex(self.sizes({"a.h": with_members(21)})[0], "^a.h:A: 21 data members, 20 at")
        inner = "class C {\n" + with_members(15) + "    int a_ = 0;\n" * 6 + "};\n"
        self.assertEqual(self.sizes({"a.h": inner}), [])

    def test_methods(self):
        def with_methods(count):
            body = "    bool f(std::function<void(int)> g,\n           int b) const;  // g(1);\n" * (count - 3)
            own = "    A() : a_{1} {}\n    operator bool() const {\n        if (a_) { return true; }\n        return g(a_);\n    }\n"
            none = "    A(const A&) = delete;\n    using G = void(int);\n    friend bool f(A);\n    std::function<void(int)> g_;\n    int a_ = f(2);\n"
            return "class A {\n  public:\n" + own + body + "\n  private:\n    bool operator==(const A&) const;\n" + none + "};\n"

        self.assertEqual(self.sizes({"a.h": with_methods(40)}), [])
        self.assertEqual(
            self.sizes({"a.h": with_methods(41)}), ["a.h:A: 41 methods, 40 at the most: split it by what it is responsible for"]
        )
        large = {"a.h:A": tree.large_classes.Large("one thing", methods=43)}
        self.assertEqual(self.sizes({"a.h": with_methods(43)}, large), [])
        self.assertRegex(self.sizes({"a.h": with_methods(44)}, large)[0], "^a.h:A: 44 methods, 43 at the most")
        self.assertRegex(self.sizes({"a.h": with_methods(40)}, large)[0], "^a.h:A: within the limits or gone")
        self.assertRegex(self.sizes({"b.h": ""}, large)[0], "^a.h:A: within the limits or gone")

    def test_every_exception_has_a_reason(self):
        for entry, one in tree.large_classes.CLASSES.items():
            self.assertGreater(len(one.why), 20, entry)
            self.assertTrue(one.methods > tree.MAX_METHODS or one.members > tree.MAX_MEMBERS, entry)

    def test_functions(self):
        def of_lines(count):
            return "void f(int a,\n       int b) {\n".replace("\n", "", 1) + "    g();\n" * (count - 2) + "}\n"

        self.assertEqual(self.sizes({"a.cpp": of_lines(60) * 3, "tests/a.cpp": of_lines(90)}), [])
        self.assertRegex(self.sizes({"a.cpp": of_lines(60) + of_lines(61)})[0], "^a.cpp:61: 61 lines of one function")

    def test_scripts(self):
        helpful = '#!/usr/bin/env bash\necho "usage: a"\n'
        self.assertEqual(self.findings(tree.scripts, {"tools/a": helpful}, ["tools/a"]), [])
        self.assertRegex(self.findings(tree.scripts, {"tools/a": helpful})[0], "^tools/a: not executable")
        silent = "#!/usr/bin/env bash\n"
        self.assertRegex(self.findings(tree.scripts, {"tools/a": silent}, ["tools/a"])[0], "^tools/a: --help must")
        broken = "#!/usr/bin/env bash\nif true; then\n"
        self.assertRegex(self.findings(tree.scripts, {".ci/a": broken}, [".ci/a"])[0], "syntax error")
        self.assertRegex(self.findings(tree.scripts, {"tools/a.sh": "case\n"})[0], "syntax error")
        self.assertRegex(self.findings(tree.scripts, {"a.py": "def f(:\n"})[0], "^a.py:1: ")


if __name__ == "__main__":
    unittest.main()
