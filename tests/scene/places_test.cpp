#include "scene/places.hpp"

#include "printing.hpp"
#include "scalar/literal.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

TEST(Places, AreThoseOfTheAssembledScene) {
  const PrecisionScope digits(40);
  const Scene scene = load_scene("gyroscope_on_gimbal");
  const auto places = places_of<Mpfr>(scene);
  const Vector<Mpfr> q = assemble<Mpfr>(scene).q0;
  const auto expect = [&](const char* name, const std::array<const char*, 3>& expected) {
    const Vector<Mpfr> found = displaced(places.at(name), 3, q);
    for (Index i = 0; i < 3; ++i)
      EXPECT_LE(magnitude(Mpfr(found[i] - literal<Mpfr>(expected[static_cast<std::size_t>(i)]))), 8 * epsilon<Mpfr>())
          << name << " " << i;
  };
  expect("post", {"0", "0", "0"});
  expect("outer", {"0", "0", "0"});
  expect("rotor", {"12/125", "-9/125", "4/25"});
  expect("rotor.d2", {"-16/25", "12/25", "3/5"});
  expect("inner[0, 0, 1/5]", {"12/125", "-9/125", "4/25"});
  EXPECT_EQ(places.size(), 1u + 3 * 4 + scene.attachments.size());
}

}  // namespace
}  // namespace hbvm::core
