#pragma once

#include <touchdown/touchdown.h>

/* Like touchdown_create, for the compiled-in model. */
#ifdef __cplusplus
extern "C"
#endif
touchdown_estimator* compiled_model(const touchdown_use* use, char* error, size_t error_size);
