#include <random>

#include "scene/assembled.hpp"
#include "scene/joined_bodies.hpp"
#include "scene/mechanism.hpp"
#include "scene/wrong_change.hpp"

namespace hbvm::core {
namespace {

TEST(MalformedScenes, OfWrongToml) {
  expect_refusals(refusal, every_key,
                  {{R"("Every key")", "\"Every key", {}},
                   {"dimension = 3", "dimension =", {}},
                   {"dimension = 3", "dimension = 3\n= 4", {}},
                   {"axis = [1, 2, 2]", "axis = [1, 2, 2", {}, "on = [\"a\"]"},
                   {"exponent = 4\n\n[[effect]]\nkind = \"spring\"",
                    "exponent = 4\nexponent = 2\n\n[[effect]]\nkind = \"spring\"",
                    {"exponent"}},
                   {"[[point]]\nname = \"pivot\"", "[constants]\n[[point]]\nname = \"pivot\"", {"constants"}},
                   {R"("made up")", "\"made\xEF\xBB\xBFup\"", {"U+FEFF"}},
                   {"[[body]]\nname = \"a\"", "# \xEF\xBB\xBF\n[[body]]\nname = \"a\"", {"U+FEFF"}},
                   {R"("made up")", "\"made\xFFup\"", {}},
                   {R"("made up")", "\"made\xC0\x80up\"", {}},
                   {R"("made up")", "\"made\x01up\"", {}},
                   {"mass = 3", "mass = 99999999999999999999", {}},
                   {"mass = 3", "mass = 03", {}}});
}

TEST(MalformedScenes, OfWrongKeys) {
  expect_refusals(
      refusal, every_key,
      {{R"(charge = "3/2")", "chrage = 1", {"'chrage'", "'charge'"}},
       {"mass = 2", "mas = 2", {"'mas'", "'mass'"}},
       {"momentum = [", "momentun = [", {"'momentun'", "'momentum'"}},
       {"source = ", "sorce = ", {"'sorce'", "'source'"}},
       {"offset = 3", "offfset = 3", {"'offfset'", "'offset'"}},
       {"rest_length", "restlength", {"'restlength'", "'rest_length'"}},
       {R"(on = ["a"])", R"(onn = ["a"])", {"'onn'", "'on'"}},
       {"second_moment = [[2", "second_momnt = [[2", {"'second_momnt'", "'second_moment'"}},
       {"[[point]]\nname = \"pivot\"", "[[pont]]\nname = \"pivot\"", {"'pont'", "'point'"}},
       {"mass = 3", "mass = 3\nxylophone = 1", {"'xylophone'"}},
       {"[constants]", "[orchestra]\nviolins = 2\n[constants]", {"'orchestra'"}},
       {"mass = 2\n", "", {"'a'", "'mass'"}, its_table},
       {"position = [1, 1, 0]\n", "", {"'c'", "'position'"}, its_table},
       {"velocity = [2, -1, 0]\n", "", {"'c'", "velocity"}, its_table},
       {"momentum = [", "velocity = [0, 0, 0]\nmomentum = [", {"'b'", "'velocity'", "'momentum'"}, its_table},
       {"name = \"c\"\n", "", {"'name'"}, its_table},
       {"dimension = 3\n", "", {"'dimension'"}, its_table},
       {"kind = \"plane\"\n", "", {"'kind'"}, its_table},
       {"length = \"unit\"\n", "", {"rod", "'length'"}, its_table},
       {"strength = 0.7\n", "", {"coulomb", "'strength'"}, its_table},
       {"center = \"pivot\"\n", "", {"central_gravity", "'center'"}, its_table},
       {"axis = [1, 2, 2]\n", "", {"oblateness", "'axis'"}, its_table}});
}

TEST(MalformedScenes, OfWrongValues) {
  expect_refusals(refusal, every_key,
                  {{"dimension = 3", "dimension = 0", {"'dimension'"}},
                   {"dimension = 3", "dimension = 4", {"'dimension'", "1, 2 or 3"}},
                   {"dimension = 3", "dimension = 3.0", {"'dimension'"}},
                   {"dimension = 3", "dimension = 2", {"'position'", "3"}, "position = [0, 0, 0]"},
                   {"velocity = [2, -1, 0]", "velocity = [2, -1]", {"'c'", "'velocity'"}},
                   {"velocity = [2, -1, 0]", "velocity = 2", {"'c'", "'velocity'"}},
                   {"velocity = [2, -1, 0]", R"(velocity = [2, "x y", 0])", {"'c'", "'velocity'", "2"}},
                   {"mass = 2", "mass = true", {"'a'", "'mass'"}},
                   {"mass = 2", "mass = 1979-05-27", {"'a'", "'mass'"}},
                   {"mass = 2", "mass = inf", {"'a'", "'mass'", "finite"}},
                   {"mass = 2", "mass = +inf", {"'a'", "'mass'", "finite"}},
                   {"mass = 2", "mass = nan", {"'a'", "'mass'", "finite"}},
                   {"mass = 2", R"(mass = "")", {"'a'", "'mass'"}},
                   {R"(length = "unit")", R"(length = "2*(unit")", {"rod", "'length'", "column 8"}},
                   {R"(length = "unit")", "length = \"\"\"2 +\n*\"\"\"", {"rod", "'length'"}},
                   {R"(mass = [[2, "1/4", 0], [0.25, 1, 0], [0, 0, 1]])", "mass = [1, 2, 3]", {"'b'", "'mass'"}},
                   {"[0.25, 1, 0], [0, 0, 1]]", "[0, 0, 1]]", {"'b'", "'mass'"}},
                   {"[0.25, 1, 0], [0, 0, 1]]", "[0.25, 1], [0, 0, 1]]", {"'b'", "'mass'", "row 2"}},
                   {"unit = ", "pi = ", {"'pi'"}},
                   {"unit = ", "sin = ", {"'sin'"}},
                   {"unit = ", R"("ä" = )", {"'ä'"}},
                   {R"(unit = "2*L")", "unit = {a = 1}", {"'unit'"}},
                   {R"("Every key")", "7", {"'title'"}},
                   {R"(name = "c")", "name = 7", {"'name'"}},
                   {R"(name = "c")", R"(name = "")", {"'name'"}},
                   {"[[rigid_body]]\nname = \"top\"", "[point2]\n[[rigid_body]]\nname = \"top\"", {"'point2'"}}});
}

TEST(MalformedScenes, OfWrongReferences) {
  expect_refusals(
      refusal, every_key,
      {{R"(name = "b")", R"(name = "a")", {"'a'"}, its_table},
       {R"(name = "b")", R"(name = "pivot")", {"'pivot'"}, its_table},
       {R"(name = "stone")", R"(name = "c")", {"'c'"}, its_table},
       {R"(between = ["pivot", "a"])", R"(between = ["pivott", "a"])", {"rod", "'pivott'", "'pivot'"}, its_table},
       {R"(body = "c")", R"(body = "zebra")", {"plane", "'zebra'"}, its_table},
       {R"(body = "c")", R"(body = "pivot")", {"plane", "'pivot'"}, its_table},
       {R"(body = "b")", R"(body = "top")", {"quadric", "'top'"}, its_table},
       {R"(between = ["pivot", "a"])", R"(between = ["pivot", "charge"])", {"rod"}, its_table},
       {R"(between = ["pivot", "a"])", R"(between = ["a", "a"])", {"rod", "'between'", "'a'", "twice"}, its_table},
       {R"(between = ["pivot", "a"])", R"(between = ["pivot", "a", "b"])", {"rod", "'between'"}, its_table},
       {R"(first = ["a", "pivot"])", R"(first = ["a"])", {"angle", "'first'"}, its_table},
       {R"(kind = "plane")", R"(kind = "plain")", {"'plane'"}, its_table},
       {R"(kind = "plane")", "kind = \"pla\\nne\"", {"'plane'"}, its_table},
       {R"(kind = "coulomb")", R"(kind = "coulom")", {"'coulomb'"}, its_table},
       {R"(center = "pivot")", R"(center = "a")", {"'center'", "'a'"}, its_table},
       {R"(on = ["a"])", R"(on = ["aa"])", {"oblateness", "'aa'"}, its_table},
       {R"(on = ["a"])", R"(on = ["a", "a"])", {"'on'", "'a'"}, its_table},
       {R"([["a", "b"], ["c", "charge"]])", R"([["a", "b"], ["b", "a"]])", {"spring", "'a'", "'b'"}},
       {R"([["a", "b"], ["c", "charge"]])", R"([["a", "b", "c"]])", {"spring", "'between'"}}});
}

TEST(MalformedScenes, EmptyFile) { expect_message(refusal(""), "test.toml:1: ", {"'dimension'"}); }

TEST(MalformedScenes, NoBody) { expect_message(refusal("dimension = 2\n"), "test.toml:1: ", {"[[body]]"}); }

TEST(MalformedScenes, NulByte) { expect_message(refusal(every_key + '\0'), "test.toml:", {}); }

TEST(MalformedScenes, PlanarRigidBodyWithVectorsOfSpace) {
  const std::string text =
      "dimension = 2\n[[rigid_body]]\nname = \"top\"\nfixed_at = [0, 0]\nmass = 1\ncenter = [0, 1]\n"
      "second_moment = [[1, 0], [0, 1]]\ndirectors = [[1, 0], [0, 1]]\nangular_velocity = [0, 0, 1]\n";
  expect_message(refusal(text), "test.toml:9: ", {"rigid_body 'top'", "'angular_velocity'", "number"});
  expect_message(refusal(changed(text, "center = [0, 1]", "center = [0, 0, 1]")),
                 "test.toml:6: ", {"'center'", "3 entries instead of 2"});
}

TEST(MalformedScenes, OfWrongJoints) {
  const char *const base = R"({ of = "base", at = [1, 0, 0] })", *const ends = R"(between = ["left", "hook"])";
  expect_refusals(
      refusal, joined_bodies,
      {{"\"bob\"\nat = [3", "\"bobb\"\nat = [3", {"attachment 'left'", "'bobb'", "did you mean 'bob'"}, its_table},
       {"\"bob\"\nat = [3", "\"bead\"\nat = [3", {"attachment 'left'", "'bead' is no rigid body"}, its_table},
       {base, R"({ of = "basis", at = [1, 0, 0] })", {"constraint 1 (hinge)", "'basis'", "did you mean 'base'"}},
       {"at = [3, 0, 0]", "at = [3, 0]", {"'at'", "2 entries instead of 3"}},
       {base, R"({ of = "base", at = [1] })", {"constraint 1 (hinge)", "'at'", "1 entries instead of 3"}},
       {"at = [3, 0, 0]\n", "", {"'at'", "missing"}, its_table},
       {base, R"({ of = "base", att = [1, 0, 0] })", {"'att'", "'at'"}},
       {base, R"({ of = "base", at = [1, 0, 0], colour = 1 })", {"'colour'"}},
       {R"(name = "left")", R"(name = "bead")", {"attachment 'bead'", "another"}, its_table},
       {R"(name = "left")", R"(name = "base[1, 0, 0]")", {"another attachment", "base[1, 0, 0]"}, base},
       {R"(name = "hook")", R"(name = "base[1, 0, 0]")", {"another body or point", "base[1, 0, 0]"}, base},
       {ends,
        R"(between = ["bob", "hook"])",
        {"rod", "'bob' is a rigid body", "name a point of it", R"({ of = "bob", at = [...] })"},
        its_table},
       {ends, R"(between = ["left", "right"])", {"rod", "both ends are points of the rigid body 'bob'"}, its_table},
       {R"(first = [{ of = "arm", at = [1, 0, 0] }, { of = "arm", at = [0, 0, 0] }])",
        R"(first = ["left", "right"])",
        {"angle", "all ends are points of the rigid body 'bob'"},
        its_table},
       {base,
        R"({ of = "arm", at = [1, 0, 0] })",
        {"hinge", "both ends are points of the rigid body 'arm'"},
        its_table},
       {base, R"({ of = "arm", at = [0, "-1/2", 0] })", {"hinge", "twice"}, its_table},
       {R"("bead", "right")",
        R"("left", "right")",
        {"spring", "both ends are points of the rigid body 'bob'"},
        its_table},
       {ends, R"(between = ["leftt", "hook"])", {"'leftt'", "did you mean 'left'"}, its_table},
       {R"(["arm", "bob"])",
        R"(["arm", "left"])",
        {"uniform_gravity", "'left' is a point of a rigid body", "'bob'"},
        its_table},
       {R"(on = ["bead", { of = "arm", at = ["1/3", 0, 1] }])",
        R"(on = [{ of = "arm", at = [1, 0, 0], charge = 1 }, { of = "arm", at = [1, 0, 0], charge = 2 }])",
        {"arm[1, 0, 0]", "charge 1"}},
       {"axis = [0, 0, 2]\n", "", {"hinge", "'axis'"}, its_table},
       {"second_axis", "seccond_axis", {"'second_axis'"}},
       {ends, R"(between = ["left", 7])", {"'between'", "must be a string"}}});
}

TEST(MalformedScenes, PlaneOfARigidBody) {
  const std::string text =
      joined_bodies + "[[constraint]]\nkind = \"plane\"\nbody = \"bob\"\nnormal = [0, 0, 1]\noffset = 0\n";
  expect_message(refusal(text), "test.toml:", {"plane", "'bob' is a rigid body; name a point of it"});
}

TEST(MalformedScenes, UnknownKindsListThoseThereAre) {
  expect_message(refusal(changed(every_key, "kind = \"coulomb\"", "kind = \"friction\"")), "test.toml:",
                 {"unknown kind of effect", "there are uniform_gravity, central_gravity", "damper", "formula",
                  "dry friction and contact are beyond"});
  expect_message(
      refusal(changed(every_key, "kind = \"plane\"", "kind = \"rolling\"")), "test.toml:",
      {"unknown kind of constraint", "there are rod, quadric, plane",
       "hinge, weld, prismatic, cylindrical, universal, gear, formula", "rolling, contact and slack ropes are beyond"});
  expect_message(refusal(changed(every_key, "charge = -1", "colour = -1")),
                 "test.toml:", {"point 'charge'", "unknown key 'colour'; those there are: charge, name, position"});
}

/// What follows the header of a table stands inside it.
TEST(MalformedScenes, KeysOfTheFileInsideATable) {
  const std::string body = "body = [{ name = \"a\", mass = 1, position = [0, 0], velocity = [0, 0] }]\n";
  expect_message(refusal("dimension = 2\n[constants]\nL = 1\n" + body),
                 "test.toml:4: ", {"constants", "'body' stands inside this table", "or as [[body]] tables"});
  expect_message(refusal("dimension = 2\n[[point]]\nname = \"o\"\nposition = [0, 0]\n" + body),
                 "test.toml:5: ", {"point 'o'", "'body' stands inside this table", "above the first header"});
  expect_message(refusal("[constants]\nL = 1\ndimension = 2\n"),
                 "test.toml:3: ", {"constants", "'dimension' stands inside this table"});
  expect_message(refusal("[[body]]\nname = \"a\"\ndimension = 2\n"),
                 "test.toml:3: ", {"body", "'dimension' stands inside this table"});
  expect_message(refusal("dimension = 2\n" + body + "[constants]\ntitle = \"A scene\"\n"),
                 "test.toml:4: ", {"constants", "'title' stands inside this table"});
  EXPECT_EQ(refusal("dimension = 2\n" + body + "[constants]\nbody = 1\n"), "") << "a number may be called so";
}

TEST(MalformedScenes, JointsOfSpaceInThePlane) {
  const std::string text = write_scene(load_scene("double_physical_pendulum")), pin = "kind = \"ball_joint\"";
  const std::string line = "test.toml:" + std::to_string(line_of(text, pin) - 1) + ": ";
  for (const auto& [kind, instead] : {std::pair("hinge", "'ball_joint'"),
                                      {"cylindrical", "a pin in a slot is an 'angle' of value 0"},
                                      {"universal", "all axes are parallel"}})
    expect_message(refusal(changed(text, pin, std::string("kind = \"") + kind + "\"\naxis = [0, 0, 1]")), line,
                   {kind, "dimension = 3", instead});
}

TEST(MalformedScenes, OfWrongMechanisms) {
  expect_refusals(refusal, mechanism,
                  {{"axis = [3, 0, 0]\n", "", {"constraint 1 (prismatic)", "'axis'", "missing"}, its_table},
                   {"axis = [3, 0, 0]", "axis = [3, 0]", {"(prismatic)", "'axis'", "2 entries instead of 3"}},
                   {"axis = [3, 0, 0]\n", "axis = [3, 0, 0]\nsecond_axis = [1, 0, 0]\n", {"'second_axis'"}},
                   {"second_axis = [0, 1, 0]\n", "", {"constraint 3 (universal)", "'second_axis'"}, its_table},
                   {"\"corner\", {", "\"plate\", {", {"(weld)", "'plate' is a rigid body", "name a point"}, its_table},
                   {"kind = \"weld\"", "kind = \"welded\"", {"did you mean 'weld'"}, its_table}});
}

TEST(MalformedScenes, BodyAsSingleTable) {
  expect_message(refusal("dimension = 2\n\n[body]\nname = \"a\"\n"), "test.toml:3: ", {"'body'", "[[body]]"});
}

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

TEST(MalformedScenes, HugeNestingOfArraysAndTables) {
  for (const char* const part : {"[", "{a="})
    expect_message(refusal("title = \"\"\nx = " + repeated(part, 100'000)), "test.toml:2: ", {});
}

TEST(MalformedScenes, HugeNestingOfBrackets) {
  const std::string text = changed(every_key, "mass = 3", "mass = \"" + repeated("(", 100'000) + "\"");
  const std::string message = refusal(text);
  EXPECT_TRUE(message.starts_with("test.toml:" + std::to_string(line_of(text, "mass = \"(("))))
      << message.substr(0, 200);
}

/// A crash would end the test program: run where it can be seen.
TEST(MalformedScenesDeathTest, HugeNestingOfDottedKeys) {
  std::vector<std::string> texts{"[" + repeated("a.", 100'000) + "b]\n"};
  for (const char* part : {"a.", "\"\xC3\xA9\".", "'!'.", "\"=\".", "'#,'.", "\"\\\"\"."})
    texts.push_back(repeated(part, 100'000) + "b = 1\n");
  for (const std::string& text : texts)
    EXPECT_EXIT(std::exit(refusal(text).empty() ? 1 : 0), ::testing::ExitedWithCode(0), "") << text.substr(0, 10);
}

TEST(MalformedScenes, DotsInAStringAreNoDottedKey) {
  for (const char* quote : {"\"", "'", "\"\"\"", "'''"})
    EXPECT_EQ(refusal(changed(every_key, "\"made up\"", quote + repeated(".", 100) + quote)), "") << quote;
}

/// toml++ asks whether they are blanks, and for these reaches a point it declares unreachable.
TEST(MalformedScenes, CharactersBeyondAsciiStandInStringsAndCommentsOnly) {
  for (const char* text :
       {"\xCE\xBC = 1\ndimension = 2\n", "\xC3\xA9", "[\xC3\xA9]", "a = \xCE\xBC", "a.\xC3\xA9 = 1",
        "a = [ \xE2\x80\x9C ]", "a.\"\xC3\xA9\" = 1", "a = \"\"\"\\\n  \xC3\xA9\"\"\"", "a = \"\"\"\\\xC3\xA9\"\"\""}) {
    const std::string message = refusal("\n" + std::string(text));
    EXPECT_NE(message.find("beyond ASCII"), std::string::npos) << text << ": " << message;
  }
  for (const char* title : {"\"\xCE\xBC\"", "'\\\xCE\xBC'", "\"\"\"\xC3\xA9\n\xC3\xA9\"\"\"", "'''\xC3\xA9'''",
                            "\"\"\"\"\xC3\xA9\"\"\"\"\"", "\"\\\"\xC3\xA9\"", "\"\" # \xC3\xA9"})
    EXPECT_EQ(refusal(changed(every_key, "\"Every key\"", title)), "") << title;
}

/// Inside a word the parser takes quotes and brackets for characters like others.
TEST(MalformedScenes, StringsDoNotGoOnAWord) {
  for (const char* text : {"a = 2\"\xC3\xA9\"", "a = [2=\"\xC3\xA9\"]", "a = 2=\"\xC3\xA9\"", "a = 2[\"\xC3\xA9\"]",
                           "a = \"b\"\"\xC3\xA9\"", "a = []\"\xC3\xA9\""}) {
    const std::string message = refusal("\n" + std::string(text));
    EXPECT_TRUE(message.starts_with("test.toml:2: ")) << text << ": " << message;
    EXPECT_NE(message.find("does not fit here"), std::string::npos) << text << ": " << message;
  }
}

void read_and_assemble(const std::string& text) {
  try {
    assembled<double>(text);
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("test.toml:")) << error.what();
  }
}

TEST(MalformedScenes, AnyBeginningIsReadOrRefused) {
  for (std::size_t length = 0; length < every_key.size(); ++length) read_and_assemble(every_key.substr(0, length));
}

TEST(MalformedScenes, AnyChangedCharactersAreReadOrRefused) {
  std::mt19937 random(1);
  const std::string characters = "\"'[]{}=#.,-+*/^()_0189eEnaxL\n\t\r \\\xEF\xBB\xBF\xC3\x01\x7F";
  for (int trial = 0; trial < 4'000; ++trial) {
    std::string text = every_key;
    for (unsigned changes = 1 + random() % 3; changes > 0; --changes)
      text[random() % text.size()] = characters[random() % characters.size()];
    read_and_assemble(text);
  }
}

}  // namespace
}  // namespace hbvm::core
