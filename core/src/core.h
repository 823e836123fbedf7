/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What all files of the core share: the version of the interface, and what is handed out of the library. */
#ifndef BDA_CORE_H
#define BDA_CORE_H

/* Add one wherever a function that Python calls, a struct or the meaning of a field changes. */
#ifndef BDA_CORE_VERSION /* a test gives another one */
#define BDA_CORE_VERSION 9
#endif

#include <float.h>

#if FLT_EVAL_METHOD != 0 || defined(__FAST_MATH__)
#error "numbers would be rounded in another way than on other processors"
#endif

/* Functions that Python calls; all others stay inside the library. */
#ifdef _WIN32
#define BDA_API __declspec(dllexport)
#else
#define BDA_API __attribute__((visibility("default")))
#endif

/* Quantities that have to be finite numbers: of bodies, and from BDA_STRAINS on of connections. */
enum {
    BDA_POSITIONS, BDA_ROTATIONS, BDA_VELOCITIES, BDA_ANGULAR_VELOCITIES, BDA_MASSES, BDA_INERTIAS, BDA_FORCES,
    BDA_CONTACT_IMPULSES, BDA_STRAINS, BDA_STIFFNESS, BDA_DAMPING, BDA_IMPULSES
};

BDA_API int bda_core_version(void);
BDA_API const char *bda_core_sources(void);

#endif
