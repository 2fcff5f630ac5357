// The product of two limbs of 32 bits for GMP and MPFR, which without it take four products of 16 bits.
#define umul_ppmm(high, low, x, y)                                     \
  do {                                                                 \
    const unsigned long long product_ = (unsigned long long)(x) * (y); \
    (high) = (mp_limb_t)(product_ >> 32);                              \
    (low) = (mp_limb_t)product_;                                       \
  } while (0)
