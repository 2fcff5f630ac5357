#include <random>

#include "scene/assemble.hpp"
#include "scene/joined_bodies.hpp"
#include "scene/scene_text.hpp"

namespace hbvm::core {
namespace {

/// every_key with `from` replaced by `to`, and what the message must hold besides the name of the file and the line.
/// The line is that of `at` in the malformed text.
struct Malformed {
  const char* name;
  const char *from, *to;
  const char* at;
  std::vector<const char*> words;
};
void PrintTo(const Malformed& m, std::ostream* out) { *out << m.to; }

std::string name_of_malformed(const ::testing::TestParamInfo<Malformed>& info) { return info.param.name; }

void expect_message(const std::string& message, const std::string& where, const std::vector<const char*>& words) {
  EXPECT_TRUE(message.starts_with(where)) << "not at " << where << " but: " << message;
  for (const char* const word : words)
    EXPECT_NE(message.find(word), std::string::npos) << word << " is not in: " << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << "more than one line: " << message;
}

/// That the scene with this change is refused.
void expect_refusal(const std::string& whole, const Malformed& m) {
  const std::string text = changed(whole, m.from, m.to);
  const std::string message = refusal(text);
  ASSERT_NE(message, "") << "not refused";
  expect_message(message, "test.toml:" + std::to_string(line_of(text, m.at)) + ": ", m.words);
}

class MalformedScene : public ::testing::TestWithParam<Malformed> {};

TEST_P(MalformedScene, IsRefusedWithFileLineAndKey) { expect_refusal(every_key, GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    Toml, MalformedScene,
    ::testing::Values(Malformed{"OpenString", "\"Every key\"", "\"Every key", "\"Every key", {}},
                      Malformed{"NoValue", "dimension = 3", "dimension =", "dimension =", {}},
                      Malformed{"NoKey", "dimension = 3", "dimension = 3\n= 4", "= 4", {}},
                      Malformed{"OpenArray", "axis = [1, 2, 2]", "axis = [1, 2, 2", "on = [\"a\"]", {}},
                      Malformed{"RepeatedKey",
                                "exponent = 4\n\n[[effect]]\nkind = \"spring\"",
                                "exponent = 4\nexponent = 2\n\n[[effect]]\nkind = \"spring\"",
                                "exponent = 2",
                                {"exponent"}},
                      Malformed{"RepeatedTable",
                                "[[point]]\nname = \"pivot\"",
                                "[constants]\n[[point]]\nname = \"pivot\"",
                                "[constants]\n[[point]]",
                                {"constants"}},
                      Malformed{"ByteOrderMarkInside", "\"made up\"", "\"made\xEF\xBB\xBFup\"", "source", {"U+FEFF"}},
                      Malformed{"ByteOrderMarkInComment",
                                "[[body]]\nname = \"a\"",
                                "# \xEF\xBB\xBF\n[[body]]\nname = \"a\"",
                                "# \xEF",
                                {"U+FEFF"}},
                      Malformed{"InvalidUtf8", "\"made up\"", "\"made\xFFup\"", "source", {}},
                      Malformed{"OverlongUtf8", "\"made up\"", "\"made\xC0\x80up\"", "source", {}},
                      Malformed{"ControlCharacter", "\"made up\"", "\"made\x01up\"", "source", {}},
                      Malformed{"HugeInteger", "mass = 3", "mass = 99999999999999999999", "mass = 99999", {}},
                      Malformed{"LeadingZero", "mass = 3", "mass = 03", "mass = 03", {}}),
    name_of_malformed);

INSTANTIATE_TEST_SUITE_P(
    Keys, MalformedScene,
    ::testing::Values(
        Malformed{"MisspeltBodyKey", "charge = \"3/2\"", "chrage = 1", "chrage", {"'chrage'", "'charge'"}},
        Malformed{"MisspeltRequiredKey", "mass = 2", "mas = 2", "mas = 2", {"'mas'", "'mass'"}},
        Malformed{"MisspeltMomentum", "momentum = [", "momentun = [", "momentun", {"'momentun'", "'momentum'"}},
        Malformed{"MisspeltTopKey", "source = ", "sorce = ", "sorce", {"'sorce'", "'source'"}},
        Malformed{"MisspeltConstraintKey", "offset = 3", "offfset = 3", "offfset", {"'offfset'", "'offset'"}},
        Malformed{"MisspeltEffectKey", "rest_length", "restlength", "restlength", {"'restlength'", "'rest_length'"}},
        Malformed{"MisspeltOn", "on = [\"a\"]", "onn = [\"a\"]", "onn", {"'onn'", "'on'"}},
        Malformed{"MisspeltRigidBodyKey",
                  "second_moment = [[2",
                  "second_momnt = [[2",
                  "second_momnt",
                  {"'second_momnt'", "'second_moment'"}},
        Malformed{"MisspeltTable",
                  "[[point]]\nname = \"pivot\"",
                  "[[pont]]\nname = \"pivot\"",
                  "[[pont]]",
                  {"'pont'", "'point'"}},
        Malformed{"UnknownKey", "mass = 3", "mass = 3\nxylophone = 1", "xylophone", {"'xylophone'"}},
        Malformed{
            "UnknownTable", "[constants]", "[orchestra]\nviolins = 2\n[constants]", "[orchestra]", {"'orchestra'"}},
        Malformed{"MissingMass", "mass = 2\n", "", "[[body]]\nname = \"a\"", {"'a'", "'mass'"}},
        Malformed{"MissingPosition", "position = [1, 1, 0]\n", "", "[[body]]\nname = \"c\"", {"'c'", "'position'"}},
        Malformed{
            "MissingVelocityAndMomentum", "velocity = [2, -1, 0]\n", "", "[[body]]\nname = \"c\"", {"'c'", "velocity"}},
        Malformed{"VelocityAndMomentum",
                  "momentum = [",
                  "velocity = [0, 0, 0]\nmomentum = [",
                  "[[body]]\nname = \"b\"",
                  {"'b'", "'velocity'", "'momentum'"}},
        Malformed{"MissingName", "name = \"c\"\n", "", "[[body]]\nmass = \"unit\"", {"'name'"}},
        Malformed{"MissingDimension", "dimension = 3\n", "", "title", {"'dimension'"}},
        Malformed{"MissingKind", "kind = \"plane\"\n", "", "[[constraint]]\nbody = \"c\"", {"'kind'"}},
        Malformed{"MissingLength", "length = \"unit\"\n", "", "[[constraint]]\nkind = \"rod\"", {"rod", "'length'"}},
        Malformed{
            "MissingStrength", "strength = 0.7\n", "", "[[effect]]\nkind = \"coulomb\"", {"coulomb", "'strength'"}},
        Malformed{"MissingCenter",
                  "center = \"pivot\"\n",
                  "",
                  "[[effect]]\nkind = \"central_gravity\"",
                  {"central_gravity", "'center'"}},
        Malformed{
            "MissingAxis", "axis = [1, 2, 2]\n", "", "[[effect]]\nkind = \"oblateness\"", {"oblateness", "'axis'"}}),
    name_of_malformed);

INSTANTIATE_TEST_SUITE_P(
    Values, MalformedScene,
    ::testing::Values(
        Malformed{"DimensionOne", "dimension = 3", "dimension = 1", "dimension", {"'dimension'"}},
        Malformed{"DimensionFour", "dimension = 3", "dimension = 4", "dimension", {"'dimension'", "2 or 3"}},
        Malformed{"RodOfOneBody",
                  "kind = \"rod\"\nbetween = [\"pivot\", \"a\"]",
                  "kind = \"rod\"\nbetween = [\"a\", \"a\"]",
                  "[[constraint]]\nkind = \"rod\"\nbetween = [\"a\", \"a\"]",
                  {"'between'", "'a'", "twice"}},
        Malformed{"DimensionDecimal", "dimension = 3", "dimension = 3.0", "dimension", {"'dimension'"}},
        Malformed{
            "PlanarWithSpatialVectors", "dimension = 3", "dimension = 2", "position = [0, 0, 0]", {"'position'", "3"}},
        Malformed{
            "ShortVector", "velocity = [2, -1, 0]", "velocity = [2, -1]", "velocity = [2, -1]", {"'c'", "'velocity'"}},
        Malformed{"VectorNotArray", "velocity = [2, -1, 0]", "velocity = 2", "velocity = 2", {"'c'", "'velocity'"}},
        Malformed{"TextInVector",
                  "velocity = [2, -1, 0]",
                  "velocity = [2, \"x y\", 0]",
                  "velocity = [2, \"x",
                  {"'c'", "'velocity'", "2"}},
        Malformed{"BooleanMass", "mass = 2", "mass = true", "mass = true", {"'a'", "'mass'"}},
        Malformed{"DateMass", "mass = 2", "mass = 1979-05-27", "mass = 1979", {"'a'", "'mass'"}},
        Malformed{"InfiniteMass", "mass = 2", "mass = inf", "mass = inf", {"'a'", "'mass'", "finite"}},
        Malformed{"SignedInfiniteMass", "mass = 2", "mass = +inf", "mass = +inf", {"'a'", "'mass'", "finite"}},
        Malformed{"NotANumber", "mass = 2", "mass = nan", "mass = nan", {"'a'", "'mass'", "finite"}},
        Malformed{"EmptyExpression", "mass = 2", "mass = \"\"", "mass = \"\"", {"'a'", "'mass'"}},
        Malformed{"MalformedExpression",
                  "length = \"unit\"",
                  "length = \"2*(unit\"",
                  "2*(unit",
                  {"rod", "'length'", "column 8"}},
        Malformed{"ExpressionOfTwoLines",
                  "length = \"unit\"",
                  "length = \"\"\"2 +\n*\"\"\"",
                  "length = ",
                  {"rod", "'length'"}},
        Malformed{"MatrixOfVectors",
                  "mass = [[2, \"1/4\", 0], [0.25, 1, 0], [0, 0, 1]]",
                  "mass = [1, 2, 3]",
                  "mass = [1, 2, 3]",
                  {"'b'", "'mass'"}},
        Malformed{"MatrixRowMissing", "[0.25, 1, 0], [0, 0, 1]]", "[0, 0, 1]]", "mass = [[2", {"'b'", "'mass'"}},
        Malformed{"MatrixRowShort",
                  "[0.25, 1, 0], [0, 0, 1]]",
                  "[0.25, 1], [0, 0, 1]]",
                  "mass = [[2",
                  {"'b'", "'mass'", "row 2"}},
        Malformed{"ConstantNamedPi", "unit = ", "pi = ", "pi = ", {"'pi'"}},
        Malformed{"ConstantNamedSin", "unit = ", "sin = ", "sin = ", {"'sin'"}},
        Malformed{"ConstantOfOtherLetters", "unit = ", "\"ä\" = ", "\"ä\" = ", {"'ä'"}},
        Malformed{"ConstantTable", "unit = \"2*L\"", "unit = {a = 1}", "unit = {", {"'unit'"}},
        Malformed{"NumericTitle", "\"Every key\"", "7", "title = 7", {"'title'"}},
        Malformed{"NumericName", "name = \"c\"", "name = 7", "name = 7", {"'name'"}},
        Malformed{"EmptyName", "name = \"c\"", "name = \"\"", "name = \"\"", {"'name'"}},
        Malformed{"SingleTable",
                  "[[rigid_body]]\nname = \"top\"",
                  "[point2]\n[[rigid_body]]\nname = \"top\"",
                  "[point2]",
                  {"'point2'"}}),
    name_of_malformed);

INSTANTIATE_TEST_SUITE_P(
    References, MalformedScene,
    ::testing::Values(
        Malformed{"DuplicateBody", "name = \"b\"", "name = \"a\"", "[[body]]\nname = \"a\"\nmass = [[", {"'a'"}},
        Malformed{"BodyNamedAsPoint", "name = \"b\"", "name = \"pivot\"", "[[body]]\nname = \"pivot\"", {"'pivot'"}},
        Malformed{"RigidBodyNamedAsBody", "name = \"stone\"", "name = \"c\"", "[[rigid_body]]\nname = \"c\"", {"'c'"}},
        Malformed{"UnknownBodyOfRod",
                  "between = [\"pivot\", \"a\"]",
                  "between = [\"pivott\", \"a\"]",
                  "[[constraint]]\nkind = \"rod\"",
                  {"rod", "'pivott'", "'pivot'"}},
        Malformed{"UnknownBodyOfPlane",
                  "body = \"c\"",
                  "body = \"zebra\"",
                  "[[constraint]]\nkind = \"plane\"",
                  {"plane", "'zebra'"}},
        Malformed{"PlaneOfPoint",
                  "body = \"c\"",
                  "body = \"pivot\"",
                  "[[constraint]]\nkind = \"plane\"",
                  {"plane", "'pivot'"}},
        Malformed{"QuadricOfRigidBody",
                  "body = \"b\"",
                  "body = \"top\"",
                  "[[constraint]]\nkind = \"quadric\"",
                  {"quadric", "'top'"}},
        Malformed{"RodBetweenPoints",
                  "between = [\"pivot\", \"a\"]",
                  "between = [\"pivot\", \"charge\"]",
                  "[[constraint]]\nkind = \"rod\"",
                  {"rod"}},
        Malformed{"RodToItself",
                  "between = [\"pivot\", \"a\"]",
                  "between = [\"a\", \"a\"]",
                  "[[constraint]]\nkind = \"rod\"",
                  {"rod", "'between'", "'a'"}},
        Malformed{"RodOfThree",
                  "between = [\"pivot\", \"a\"]",
                  "between = [\"pivot\", \"a\", \"b\"]",
                  "[[constraint]]\nkind = \"rod\"",
                  {"rod", "'between'"}},
        Malformed{"AngleOfOne",
                  "first = [\"a\", \"pivot\"]",
                  "first = [\"a\"]",
                  "[[constraint]]\nkind = \"angle\"",
                  {"angle", "'first'"}},
        Malformed{"UnknownConstraint",
                  "kind = \"plane\"",
                  "kind = \"plain\"",
                  "[[constraint]]\nkind = \"plain\"",
                  {"'plane'"}},
        Malformed{"ConstraintOfTwoLines",
                  "kind = \"plane\"",
                  "kind = \"pla\\nne\"",
                  "[[constraint]]\nkind = \"pla",
                  {"'plane'"}},
        Malformed{
            "UnknownEffect", "kind = \"coulomb\"", "kind = \"coulom\"", "[[effect]]\nkind = \"coulom\"", {"'coulomb'"}},
        Malformed{"UnknownCenter",
                  "center = \"pivot\"",
                  "center = \"a\"",
                  "[[effect]]\nkind = \"central_gravity\"",
                  {"'center'", "'a'"}},
        Malformed{"UnknownBodyOfOn",
                  "on = [\"a\"]",
                  "on = [\"aa\"]",
                  "[[effect]]\nkind = \"oblateness\"",
                  {"oblateness", "'aa'"}},
        Malformed{"OnNamesTwice",
                  "on = [\"a\"]",
                  "on = [\"a\", \"a\"]",
                  "[[effect]]\nkind = \"oblateness\"",
                  {"'on'", "'a'"}},
        Malformed{"PairTwice",
                  "[[\"a\", \"b\"], [\"c\", \"charge\"]]",
                  "[[\"a\", \"b\"], [\"b\", \"a\"]]",
                  "between = [[",
                  {"spring", "'a'", "'b'"}},
        Malformed{"PairOfThree",
                  "[[\"a\", \"b\"], [\"c\", \"charge\"]]",
                  "[[\"a\", \"b\", \"c\"]]",
                  "between = [[",
                  {"spring", "'between'"}}),
    name_of_malformed);

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

/// The scene of joined bodies with one thing wrong.
class MalformedJoint : public ::testing::TestWithParam<Malformed> {};

TEST_P(MalformedJoint, IsRefusedWithFileLineAndKey) { expect_refusal(joined_bodies, GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    Joints, MalformedJoint,
    ::testing::Values(
        Malformed{"UnknownRigidBody",
                  "of = \"bob\"\nat = [3",
                  "of = \"bobb\"\nat = [3",
                  "[[attachment]]\nname = \"left\"",
                  {"attachment 'left'", "'bobb'", "did you mean 'bob'"}},
        Malformed{"OfABody",
                  "of = \"bob\"\nat = [3",
                  "of = \"bead\"\nat = [3",
                  "[[attachment]]\nname = \"left\"",
                  {"attachment 'left'", "'bead' is no rigid body"}},
        Malformed{"UnknownRigidBodyInPlace",
                  "{ of = \"base\", at = [1, 0, 0] }",
                  "{ of = \"basis\", at = [1, 0, 0] }",
                  "{ of = \"basis\"",
                  {"constraint 1 (hinge)", "'basis'", "did you mean 'base'"}},
        Malformed{"TooShort", "at = [3, 0, 0]", "at = [3, 0]", "at = [3, 0]", {"'at'", "2 entries instead of 3"}},
        Malformed{"TooShortInPlace",
                  "{ of = \"base\", at = [1, 0, 0] }",
                  "{ of = \"base\", at = [1] }",
                  "{ of = \"base\", at = [1] }",
                  {"constraint 1 (hinge)", "'at'", "1 entries instead of 3"}},
        Malformed{"MissingAt", "at = [3, 0, 0]\n", "", "[[attachment]]\nname = \"left\"", {"'at'", "missing"}},
        Malformed{"MisspeltKeyInPlace",
                  "{ of = \"base\", at = [1, 0, 0] }",
                  "{ of = \"base\", att = [1, 0, 0] }",
                  "{ of = \"base\", att",
                  {"'att'", "'at'"}},
        Malformed{"UnknownKeyInPlace",
                  "{ of = \"base\", at = [1, 0, 0] }",
                  "{ of = \"base\", at = [1, 0, 0], colour = 1 }",
                  "{ of = \"base\", at = [1, 0, 0], colour",
                  {"'colour'"}},
        Malformed{"NamedAsABody",
                  "name = \"left\"",
                  "name = \"bead\"",
                  "[[attachment]]\nname = \"bead\"",
                  {"attachment 'bead'", "another"}},
        Malformed{"NamedAsAnotherPointInPlace",
                  "name = \"left\"",
                  "name = \"base[1, 0, 0]\"",
                  "{ of = \"base\", at = [1, 0, 0] }",
                  {"another attachment", "base[1, 0, 0]"}},
        Malformed{"PointNamedAsOneInPlace",
                  "name = \"hook\"",
                  "name = \"base[1, 0, 0]\"",
                  "{ of = \"base\", at = [1, 0, 0] }",
                  {"another body or point", "base[1, 0, 0]"}},
        Malformed{"RodOnARigidBody",
                  "between = [\"left\", \"hook\"]",
                  "between = [\"bob\", \"hook\"]",
                  "[[constraint]]\nkind = \"rod\"",
                  {"rod", "'bob' is a rigid body", "name a point of it", "{ of = \"bob\", at = [...] }"}},
        Malformed{"RodWithinARigidBody",
                  "between = [\"left\", \"hook\"]",
                  "between = [\"left\", \"right\"]",
                  "[[constraint]]\nkind = \"rod\"",
                  {"rod", "both ends are points of the rigid body 'bob'"}},
        Malformed{"AngleWithinARigidBody",
                  "first = [{ of = \"arm\", at = [1, 0, 0] }, { of = \"arm\", at = [0, 0, 0] }]",
                  "first = [\"left\", \"right\"]",
                  "[[constraint]]\nkind = \"angle\"",
                  {"angle", "all ends are points of the rigid body 'bob'"}},
        Malformed{"HingeWithinARigidBody",
                  "{ of = \"base\", at = [1, 0, 0] }",
                  "{ of = \"arm\", at = [1, 0, 0] }",
                  "[[constraint]]\nkind = \"hinge\"",
                  {"hinge", "both ends are points of the rigid body 'arm'"}},
        Malformed{"SamePointTwice",
                  "{ of = \"base\", at = [1, 0, 0] }",
                  "{ of = \"arm\", at = [0, \"-1/2\", 0] }",
                  "[[constraint]]\nkind = \"hinge\"",
                  {"hinge", "twice"}},
        Malformed{"SpringWithinARigidBody",
                  "[\"bead\", \"right\"]",
                  "[\"left\", \"right\"]",
                  "[[effect]]\nkind = \"spring\"",
                  {"spring", "both ends are points of the rigid body 'bob'"}},
        Malformed{"UnknownAttachment",
                  "between = [\"left\", \"hook\"]",
                  "between = [\"leftt\", \"hook\"]",
                  "[[constraint]]\nkind = \"rod\"",
                  {"'leftt'", "did you mean 'left'"}},
        Malformed{"GravityOnAPoint",
                  "on = [\"arm\", \"bob\"]",
                  "on = [\"arm\", \"left\"]",
                  "[[effect]]\nkind = \"uniform_gravity\"",
                  {"uniform_gravity", "'left' is a point of a rigid body", "'bob'"}},
        Malformed{"TwoCharges",
                  "on = [\"bead\", { of = \"arm\", at = [\"1/3\", 0, 1] }]",
                  "on = [{ of = \"arm\", at = [1, 0, 0], charge = 1 }, { of = \"arm\", at = [1, 0, 0], charge = 2 }]",
                  "on = [{ of",
                  {"arm[1, 0, 0]", "charge 1"}},
        Malformed{"MissingAxis", "axis = [0, 0, 2]\n", "", "[[constraint]]\nkind = \"hinge\"", {"hinge", "'axis'"}},
        Malformed{"MisspeltSecondAxis", "second_axis", "seccond_axis", "seccond_axis", {"'second_axis'"}},
        Malformed{"NumberAsName",
                  "between = [\"left\", \"hook\"]",
                  "between = [\"left\", 7]",
                  "between = [\"left\", 7]",
                  {"'between'", "must be a string"}}),
    name_of_malformed);

TEST(MalformedScenes, PlaneOfARigidBody) {
  const std::string text =
      joined_bodies + "[[constraint]]\nkind = \"plane\"\nbody = \"bob\"\nnormal = [0, 0, 1]\noffset = 0\n";
  expect_message(refusal(text), "test.toml:", {"plane", "'bob' is a rigid body; name a point of it"});
}

TEST(MalformedScenes, UnknownKindsListThoseThereAre) {
  const std::string effect = refusal(changed(every_key, "kind = \"coulomb\"", "kind = \"friction\""));
  expect_message(effect, "test.toml:",
                 {"unknown kind of effect", "there are uniform_gravity, central_gravity", "formula",
                  "friction, damping, motors and magnetic fields are beyond"});
  const std::string constraint = refusal(changed(every_key, "kind = \"plane\"", "kind = \"rolling\""));
  expect_message(constraint, "test.toml:",
                 {"unknown kind of constraint", "there are rod, quadric, plane", "hinge, formula",
                  "rolling, contact and slack ropes are beyond"});
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

TEST(MalformedScenes, HingeInThePlane) {
  std::string text = write_scene(load_scene("double_physical_pendulum"));
  text = changed(text, "kind = \"ball_joint\"", "kind = \"hinge\"\naxis = [0, 0, 1]");
  expect_message(refusal(text), "test.toml:", {"hinge", "dimension = 3", "'ball_joint'"});
}

TEST(MalformedScenes, BodyAsSingleTable) {
  expect_message(refusal("dimension = 2\n\n[body]\nname = \"a\"\n"), "test.toml:3: ", {"'body'", "[[body]]"});
}

std::string repeated(const std::string& part, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += part;
  return text;
}

TEST(MalformedScenes, HugeNestingOfArrays) {
  expect_message(refusal("title = \"\"\nx = " + repeated("[", 100'000)), "test.toml:2: ", {});
}

TEST(MalformedScenes, HugeNestingOfTables) {
  expect_message(refusal("title = \"\"\nx = " + repeated("{a=", 100'000)), "test.toml:2: ", {});
}

TEST(MalformedScenes, HugeNestingOfBrackets) {
  const std::string text = changed(every_key, "mass = 3", "mass = \"" + repeated("(", 100'000) + "\"");
  const std::string message = refusal(text);
  EXPECT_TRUE(message.starts_with("test.toml:" + std::to_string(line_of(text, "mass = \"(("))))
      << message.substr(0, 200);
}

/// A crash would end the test program: run where it can be seen.
TEST(MalformedScenesDeathTest, HugeNestingOfDottedKeys) {
  EXPECT_EXIT(std::exit(refusal(repeated("a.", 100'000) + "b = 1\n").empty() ? 1 : 0), ::testing::ExitedWithCode(0),
              "");
}

TEST(MalformedScenesDeathTest, HugeNestingOfDottedQuotedKeys) {
  for (const char* part : {"\"\xC3\xA9\".", "'!'.", "\"=\".", "'#,'.", "\"\\\"\"."})
    EXPECT_EXIT(std::exit(refusal(repeated(part, 100'000) + "b = 1\n").empty() ? 1 : 0), ::testing::ExitedWithCode(0),
                "");
}

TEST(MalformedScenesDeathTest, HugeNestingOfDottedTableNames) {
  EXPECT_EXIT(std::exit(refusal("[" + repeated("a.", 100'000) + "b]\n").empty() ? 1 : 0), ::testing::ExitedWithCode(0),
              "");
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
    assemble<double>(read_scene(text, "test.toml"));
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
