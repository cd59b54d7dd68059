/* A minimal program that is linked with the library, but not with Vulkan's own library. */

#include <gpc.h>

#include <stdio.h>
#include <string.h>

int main(void) {
    GpcOptions options;
    GpcAntialiaser *antialiaser = NULL;
    if (gpc_version() != GPC_VERSION) return 1;
    if (gpc_init_options(&options, sizeof options) != GPC_RESULT_SUCCESS || options.samples != 64) return 2;
    if (gpc_antialiaser_create(NULL, &antialiaser) != GPC_RESULT_NULL || antialiaser) return 3;
    if (strcmp(gpc_last_error(), "GpcDevice is NULL") != 0) return 4;
    puts("linked");
    return 0;
}
