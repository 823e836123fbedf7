/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Calls every function of the core, built with sanitizers: these end the program at the first fault. */
#include "core.h"

#include <stdio.h>
#include <string.h>

int main(void) {
    if (bda_core_version() != BDA_CORE_VERSION || strlen(bda_core_sources()) == 0) {
        fprintf(stderr, "the core does not say which it is\n");
        return 1;
    }
    return 0;
}
