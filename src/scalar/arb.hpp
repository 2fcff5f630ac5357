#pragma once

// Balls of Arb: a part of FLINT from its version 3 on, and a library beside it before.
#if __has_include(<flint/acb.h>)
#include <flint/acb.h>
#include <flint/arb_hypgeom.h>
#else
#include <acb.h>
#include <arb_hypgeom.h>
#endif
