/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which core this is: Python asks before it calls anything else. */
#include "core.h"

/* Returns the version of the interface. */
int bda_core_version(void) { return BDA_CORE_VERSION; }

/* Returns the digest of the files that the library was built from, by which a checkout finds an old one. */
const char *bda_core_sources(void) { return BDA_CORE_SOURCES; }
