// Our own reader of .msh files: what it refuses, and how it says where.
#include "mesh_files/msh_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "base/errors.hpp"
#include "gmsh/load_mesh.hpp"
#include "msh_files.hpp"
#include "support/messages.hpp"
#include "support/temporary_folder.hpp"

namespace mortise {
namespace {

using test::message_of;
using test::msh_2;
using test::msh_4;
using test::replaced;
using test::TemporaryFolder;

struct Broken {
  std::string name, text, place;  // the place follows the file's name
  std::vector<std::string> said;
};

const Broken broken[] = {
    {"Empty", "", ", line 1", {"no .msh", "expected $MeshFormat", "nothing"}},
    {"OfOtherKind", "hello world\n", ", line 1", {"expected $MeshFormat", "'hello world'"}},
    {"OldVersion", replaced(msh_4(), "4.1", "4.0"), ", line 2, $MeshFormat", {"2.2 or 4.1"}},
    {"SizesOf4Bytes", replaced(msh_4(), "0 8", "0 4"), ", line 2, $MeshFormat", {"8"}},
    {"NoNodes", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Elements\n0\n$EndElements\n", ", line 4", {"before the nodes"}},
    {"NoElements", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n0\n$EndNodes\n", "", {"no section $Elements"}},
    {"SecondNodes", msh_2() + "$Nodes\n1\n9 0 0 0\n$EndNodes\n", ", line 22, $Nodes", {"second time"}},
    {"SecondElements", msh_2() + "$Elements\n0\n$EndElements\n", ", line 22, $Elements", {"second time"}},
    {"SecondNames", msh_2() + "$PhysicalNames\n0\n$EndPhysicalNames\n", ", line 22", {"second time"}},
    {"NoEndOfElements", replaced(msh_2(), "$EndElements\n", ""), ", line 21, $Elements", {"expected $EndElements"}},
    {"NoEndOfAnOther", msh_2() + "$Other\n1\n", ", line 22, $Other", {"no $EndOther"}},
    {"TextBetweenSections", replaced(msh_2(), "$Nodes", "nodes:\n$Nodes"), ", line 9", {"'nodes:'"}},
    {"OneElementMoreThanSaid",
     replaced(msh_2(), "$Elements\n2", "$Elements\n1"),
     ", line 20, $Elements",
     {"expected $EndElements", "'2 3 2 1 1 1 2 3 4'"}},
    {"OneElementFewerThanSaid",
     replaced(msh_2(), "$Elements\n2", "$Elements\n3"),
     ", line 21, $Elements",
     {"an element's tag", "'$EndElements'"}},
    {"OneNodeFewerThanSaid", replaced(msh_2(), "$Nodes\n5", "$Nodes\n6"), ", line 16, $Nodes", {"'$EndNodes'"}},
    {"OneNodeMoreThanSaid", replaced(msh_2(), "$Nodes\n5", "$Nodes\n4"), ", line 15, $Nodes", {"expected $EndNodes"}},
    {"OneElementTooFewIn41",
     replaced(msh_4(), "$Elements\n2 2", "$Elements\n2 3"),
     ", line 28, $Elements",
     {"says 3 elements", "lists 2"}},
    {"OneNodeTooFewIn41", replaced(msh_4(), "$Nodes\n2 4", "$Nodes\n2 5"), ", line 15, $Nodes", {"says 5 nodes"}},
    {"MoreBlocksThanSaidIn41",
     replaced(msh_4(), "$Elements\n2 2", "$Elements\n1 1"),
     ", line 31, $Elements",
     {"expected $EndElements"}},
    {"CountOfNodesTooLarge",
     replaced(msh_2(), "$Nodes\n5", "$Nodes\n999999999999"),
     ", line 10, $Nodes",
     {"999999999999", "room for no more than"}},
    {"CountOfNodesNegative", replaced(msh_2(), "$Nodes\n5", "$Nodes\n-5"), ", line 10, $Nodes", {"-5"}},
    {"CountOfElementsTooLargeIn41",
     replaced(msh_4(), "2 1 3 1\n", "2 1 3 4611686018427387904\n"),
     ", line 31, $Elements",
     {"room for no more than"}},
    {"CountLargerThanAnyInteger",
     replaced(msh_2(), "$Nodes\n5", "$Nodes\n99999999999999999999999"),
     ", line 10, $Nodes",
     {"expected the number of nodes"}},
    {"NodeWithTagZero", replaced(msh_2(), "5 2 0 0", "0 2 0 0"), ", line 15, $Nodes", {"tag is 0", "> 0"}},
    {"NodeWithNegativeTag", replaced(msh_2(), "5 2 0 0", "-5 2 0 0"), ", line 15, $Nodes", {"tag is -5"}},
    {"NodeListedTwice", replaced(msh_2(), "5 2 0 0", "3 2 0 0"), ", line 15, $Nodes", {"node 3 is listed twice"}},
    {"NodeWithTwoCoordinates", replaced(msh_2(), "5 2 0 0", "5 2 0"), ", line 15, $Nodes", {"the end of the line"}},
    {"NodeWithFourCoordinates", replaced(msh_2(), "5 2 0 0", "5 2 0 0 0"), ", line 15, $Nodes", {"found '0'"}},
    {"CoordinateThatIsNoNumber", replaced(msh_2(), "5 2 0 0", "5 2 zero 0"), ", line 15, $Nodes", {"'zero'"}},
    {"CoordinateNotFinite", replaced(msh_2(), "5 2 0 0", "5 nan 0 0"), ", line 15, $Nodes", {"not a finite"}},
    {"CoordinateTooLarge", replaced(msh_2(), "5 2 0 0", "5 1e999 0 0"), ", line 15, $Nodes", {"'1e999'"}},
    {"ElementOfUnknownNode",
     replaced(msh_2(), "1 2 3 4\n", "1 2 3 9\n"),
     ", line 20, $Elements",
     {"node 9 of the element 2", "not in $Nodes"}},
    {"ElementOfUnknownKind",
     replaced(msh_2(), "2 3 2 1 1", "2 999 2 1 1"),
     ", line 20, $Elements",
     {"no kind of element with the number 999"}},
    {"ElementWithTagZero", replaced(msh_2(), "2 3 2 1 1", "0 3 2 1 1"), ", line 20, $Elements", {"tag is 0"}},
    {"ElementTagTwice", replaced(msh_2(), "2 3 2 1 1", "1 3 2 1 1"), ", line 20, $Elements", {"1 is listed twice"}},
    {"ElementWithTooFewNodes", replaced(msh_2(), "1 2 3 4\n", "1 2 3\n"), ", line 20, $Elements", {"end of the line"}},
    {"ElementWithTooManyNodes",
     replaced(msh_2(), "1 2 3 4\n", "1 2 3 4 5\n"),
     ", line 20, $Elements",
     {"expected the end of the line, found '5'"}},
    {"NegativeNumberOfTags", replaced(msh_2(), "2 3 2 1 1", "2 3 -2 1 1"), ", line 20, $Elements", {"-2"}},
    {"KindOfOtherDimensionIn41",
     replaced(msh_4(), "2 1 3 1\n", "1 1 3 1\n"),
     ", line 31, $Elements",
     {"'Quadrilateral 4'", "dimension 1"}},
    {"EntityNotListedIn41",
     replaced(msh_4(), "2 1 3 1\n", "2 7 3 1\n"),
     ", line 31, $Elements",
     {"tag 7 is not in $Entities"}},
    {"EntityTwiceIn41",
     replaced(replaced(msh_4(), "0 1 1 0", "0 2 1 0"), "1 0 0 0 1 0 0 1 -2 0 ", "1 0 0 0 1 0 0 0 0\n1 0 0 0 1 0 0 0 0"),
     ", line 12, $Entities",
     {"listed twice"}},
    {"NameWithoutQuotes", replaced(msh_2(), "\"edge\"", "edge"), ", line 6, $PhysicalNames", {"'1 2 edge'"}},
    {"GroupOfTwoNames", replaced(msh_2(), "1 2 \"edge\"", "2 1 \"edge\""), ", line 7, $PhysicalNames", {"two names"}},
    {"Partitioned",
     replaced(msh_4(), "$Nodes", "$PartitionedEntities\n$EndPartitionedEntities\n$Nodes"),
     ", line 14",
     {"partitioned"}},
};

class BrokenMsh : public testing::TestWithParam<Broken> {};

TEST_P(BrokenMsh, IsRefusedWithFileLineAndSection) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.msh", GetParam().text);
  const std::string message = message_of<InputError>([&] { load_mesh(file, {}); });
  EXPECT_TRUE(message.starts_with(file + GetParam().place)) << message;
  for (const std::string& said : GetParam().said) test::expect_contains(message, said);
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(Table, BrokenMsh, testing::ValuesIn(broken),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(MshFile, BothFormatsHoldOneMesh) {
  const TemporaryFolder folder;
  const Mesh two = load_mesh(folder.write("2.msh", msh_2()), {});
  const Mesh four = load_mesh(folder.write("4.msh", msh_4()), {});
  EXPECT_EQ(two.nodes, four.nodes);
  EXPECT_EQ(two.nodes.rows(), 4);  // the fifth belongs to no body
  EXPECT_EQ(two.bodies, std::vector<std::string>{"body"});
  EXPECT_EQ(four.bodies, two.bodies);
  ASSERT_EQ(four.boundaries.size(), 1U);
  EXPECT_EQ(four.boundaries[0].name, "edge");
  EXPECT_EQ(four.boundaries[0].edges.size(), 1U);
  ASSERT_EQ(four.cells.size(), 1U);
  EXPECT_EQ(four.cells[0].nodes, two.cells[0].nodes);
}

TEST(MshFile, OtherSectionsCommentsBlankLinesAndWindowsLineEndsArePassedOver) {
  const TemporaryFolder folder;
  std::string text = replaced(msh_2(), "$Nodes", "$Comments\nmade by hand $Nodes\n$EndComments\n\n$Nodes") +
                     "\n$NodeData\n1\n\"u\"\n$EndNodeData\n";
  EXPECT_EQ(load_mesh(folder.write("a.msh", text), {}).cells.size(), 1U);
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2)) text.insert(at, "\r");
  EXPECT_EQ(load_mesh(folder.write("b.msh", text), {}).cells.size(), 1U);
}

TEST(MshFile, TagsMayBeAnyPositiveNumbers) {
  const TemporaryFolder folder;
  const std::string nodes = "7 0 0 0\n1000000000000 1 0 0\n30 1 1 0\n4 0 1 0\n";
  const std::string elements = "5 1 2 2 1 7 30\n99 2 2 1 1 7 30 4\n";
  EXPECT_EQ(read_msh(folder.write("a.msh", msh_2(nodes, elements))).nodes.size(), 4U);
}

TEST(MshFile, ACellListedTwiceIsRefused) {
  const TemporaryFolder folder;
  const std::string twice = test::square_elements + "3 3 2 1 1 2 3 4 1\n";
  const std::string file = folder.write("a.msh", msh_2(test::square_nodes, twice));
  EXPECT_EQ(message_of([&] { load_mesh(file, {}); }),
            file + ": the cell near (0.5, 0.5) is listed twice, in body 'body'");
}

TEST(MshFile, ACellInTwoBodiesIsRefused) {
  const TemporaryFolder folder;
  const std::string twice = test::square_elements + "3 3 2 5 1 1 2 3 4\n";
  const std::string text = replaced(replaced(msh_2(test::square_nodes, twice), "Names\n2", "Names\n3"), "1 2 \"edge\"",
                                    "1 2 \"edge\"\n2 5 \"other\"");
  const std::string file = folder.write("a.msh", text);
  EXPECT_EQ(message_of([&] { load_mesh(file, {}); }),
            file + ": the cell near (0.5, 0.5) is listed twice, in the bodies 'body' and 'other'");
}

TEST(MshFile, AnEdgeListedTwiceIsRefused) {
  const TemporaryFolder folder;
  const std::string twice = "1 1 2 2 1 1 2\n2 3 2 1 1 1 2 3 4\n3 1 2 2 1 2 1\n";
  const std::string file = folder.write("a.msh", msh_2(test::square_nodes, twice));
  EXPECT_EQ(message_of([&] { load_mesh(file, {}); }),
            file + ": boundary 'edge': the edge near (0.5, 0) is listed twice");
}

TEST(MshFile, ACurveMayBeInTwoPhysicalCurves) {
  // In format 2.2 its elements stand there twice, once for each.
  const TemporaryFolder folder;
  const std::string elements = "1 1 2 2 1 1 2\n2 1 2 6 1 1 2\n3 3 2 1 1 1 2 3 4\n";
  const std::string text = replaced(replaced(msh_2(test::square_nodes, elements), "Names\n2", "Names\n3"),
                                    "1 2 \"edge\"", "1 2 \"edge\"\n1 6 \"low\"");
  const Mesh mesh = load_mesh(folder.write("a.msh", text), {});
  EXPECT_EQ(boundary_names(mesh), (std::vector<std::string>{"edge", "low"}));
  for (const Boundary& boundary : mesh.boundaries) EXPECT_EQ(boundary.edges.size(), 1U);
}

TEST(MshFile, ASurfaceInNoBodyIsRefused) {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("a.msh", msh_2(test::square_nodes, test::square_elements + "3 2 2 0 8 2 5 3\n"));
  EXPECT_EQ(message_of([&] { load_mesh(file, {}); }),
            file + ": surface 8 near (1, 0) is in no physical surface; every meshed surface belongs to a body");
}

TEST(MshFile, ANameWithControlCharactersIsRefusedInOneLine) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.msh", replaced(msh_2(), "\"body\"", "\"bo\x1b[2Jdy\""));
  const std::string message = message_of([&] { load_mesh(file, {}); });
  test::expect_contains(message, "bo\\x1b[2Jdy");
  EXPECT_EQ(message.find('\x1b'), std::string::npos);
}

// ---- Damaged files: each piece of every good file that is cut off or out must be missed ----

class DamagedMsh : public testing::TestWithParam<std::array<int, 2>> {};  // version (2 or 4), binary

template <typename T>
void put(std::string& text, T value) {
  text.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

void put_ints(std::string& text, std::initializer_list<std::int32_t> values) {
  for (const std::int32_t value : values) put(text, value);
}

void put_sizes(std::string& text, std::initializer_list<std::int64_t> values) {
  for (const std::int64_t value : values) put(text, value);
}

void put_reals(std::string& text, std::initializer_list<double> values) {
  for (const double value : values) put(text, value);
}

std::string binary_start(const std::string& version) {
  std::string text = "$MeshFormat\n" + version + " 1 8\n";
  put_ints(text, {1});
  return text + "\n$EndMeshFormat\n$PhysicalNames\n2\n1 2 \"edge\"\n2 1 \"body\"\n$EndPhysicalNames\n";
}

std::string binary_2() {
  std::string text = binary_start("2.2") + "$Nodes\n4\n";
  for (int i = 0; i < 4; ++i) {
    put_ints(text, {i + 1});
    put_reals(text, {i == 1 || i == 2 ? 1.0 : 0.0, i > 1 ? 1.0 : 0.0, 0.0});
  }
  text += "\n$EndNodes\n$Elements\n2\n";
  put_ints(text, {1, 1, 2, 1, 2, 1, 1, 2});        // a run of one line: its tag, group, entity, nodes
  put_ints(text, {3, 1, 2, 2, 1, 1, 1, 2, 3, 4});  // and one quadrilateral
  return text + "\n$EndElements\n";
}

std::string binary_4() {
  std::string text = binary_start("4.1") + "$Entities\n";
  put_sizes(text, {0, 1, 1, 0});
  for (const int dimension : {1, 2}) {
    put_ints(text, {1});
    put_reals(text, {0, 0, 0, 1, 1, 0});
    put_sizes(text, {1});
    put_ints(text, {dimension == 1 ? 2 : 1});
    put_sizes(text, {0});
  }
  text += "\n$EndEntities\n$Nodes\n";
  put_sizes(text, {1, 4, 1, 4});
  put_ints(text, {2, 1, 0});
  put_sizes(text, {4, 1, 2, 3, 4});
  put_reals(text, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  text += "\n$EndNodes\n$Elements\n";
  put_sizes(text, {2, 2, 1, 2});
  put_ints(text, {1, 1, 1});
  put_sizes(text, {1, 1, 1, 2});
  put_ints(text, {2, 1, 3});
  put_sizes(text, {1, 2, 1, 2, 3, 4});
  return text + "\n$EndElements\n";
}

std::string good_file(const std::array<int, 2>& kind) {
  if (kind[1] != 0) return kind[0] == 2 ? binary_2() : binary_4();
  return kind[0] == 2 ? msh_2() : msh_4();
}

TEST_P(DamagedMsh, WholeItIsRead) {
  const TemporaryFolder folder;
  const Mesh mesh = load_mesh(folder.write("a.msh", good_file(GetParam())), {});
  EXPECT_EQ(mesh.cells.size(), 1U);
  EXPECT_EQ(mesh.boundaries.at(0).edges.size(), 1U);
}

TEST_P(DamagedMsh, CutOffAnywhereItIsRefused) {
  const TemporaryFolder folder;
  const std::string text = good_file(GetParam());
  for (std::size_t size = 0; size + 1 < text.size(); ++size) {
    const std::string file = folder.write("a.msh", text.substr(0, size));
    const std::string message = message_of<InputError>([&] { load_mesh(file, {}); });
    EXPECT_TRUE(message.starts_with(file)) << "cut to " << size << " bytes: " << message;
  }
}

TEST_P(DamagedMsh, WithOtherBytesItIsRefusedOrRead) {
  const TemporaryFolder folder;
  const std::string text = good_file(GetParam());
  for (std::size_t i = 0; i < text.size(); ++i) {
    for (const char byte : {'\0', '9', '-', '\n', '\x7f', '\xff'}) {
      std::string other = text;
      other[i] = byte;
      const std::string file = folder.write("a.msh", other);
      try {
        load_mesh(file, {});
      } catch (const InputError& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with(file)) << error.what();
      }
    }
  }
}

TEST_P(DamagedMsh, WithoutOneOfItsLinesItIsRefused) {
  const auto [version, binary] = GetParam();
  if (binary != 0) return;  // has no lines
  const TemporaryFolder folder;
  const std::string text = good_file(GetParam());
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = text.find('\n', start) + 1;
    const std::string line = text.substr(start, end - start);
    const std::string file = folder.write("a.msh", text.substr(0, start) + text.substr(end));
    EXPECT_TRUE(message_of<InputError>([&] { load_mesh(file, {}); }).starts_with(file)) << "without " << line;
    start = end;
  }
}

INSTANTIATE_TEST_SUITE_P(All, DamagedMsh,
                         testing::Values(std::array{2, 0}, std::array{2, 1}, std::array{4, 0}, std::array{4, 1}),
                         [](const auto& kind) {
                           return std::string(kind.param[0] == 2 ? "Version2" : "Version4") +
                                  (kind.param[1] != 0 ? "Binary" : "Text");
                         });

TEST(BinaryMsh, OfTheOtherByteOrderIsRefused) {
  const TemporaryFolder folder;
  std::string text = binary_4();
  const std::size_t at = text.find("4.1 1 8\n") + 8;
  std::reverse(text.begin() + static_cast<std::ptrdiff_t>(at), text.begin() + static_cast<std::ptrdiff_t>(at) + 4);
  const std::string file = folder.write("a.msh", text);
  test::expect_contains(message_of([&] { load_mesh(file, {}); }), "other byte order");
}

TEST(BinaryMsh, TheByteIsNamed) {
  const TemporaryFolder folder;
  const std::string file = folder.write("a.msh", replaced(binary_2(), "$Nodes\n4", "$Nodes\n9"));
  test::expect_contains(message_of([&] { load_mesh(file, {}); }), ", $Nodes: the number of nodes is 9");
}

}  // namespace
}  // namespace mortise
