#pragma once

// Balls of Arb: a part of FLINT from its version 3 on, and a library beside it before.
#if __has_include(<flint/acb.h>)
#include <flint/acb.h>
#include <flint/arb_hypgeom.h>
#else
#include <acb.h>
#include <arb_hypgeom.h>
#endif

namespace hbvm::core {

/// A real number between bounds: a centre and a radius about it.
class RealBall {
 public:
  RealBall() { arb_init(value_); }
  RealBall(int whole) : RealBall() { arb_set_si(value_, whole); }
  RealBall(const RealBall& other) : RealBall() { arb_set(value_, other.value_); }
  RealBall(RealBall&& other) noexcept : RealBall() { arb_swap(value_, other.value_); }
  RealBall& operator=(RealBall other) noexcept {
    arb_swap(value_, other.value_);
    return *this;
  }
  ~RealBall() { arb_clear(value_); }

  friend arb_ptr raw(RealBall& x) { return x.value_; }
  friend arb_srcptr raw(const RealBall& x) { return x.value_; }

 private:
  arb_t value_;
};

}  // namespace hbvm::core
