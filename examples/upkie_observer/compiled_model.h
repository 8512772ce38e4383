#pragma once

#include <touchdown/touchdown.h>

/* As touchdown_create, of the model that is compiled in. */
#ifdef __cplusplus
extern "C"
#endif
touchdown_estimator* compiled_model(const touchdown_use* use, char* error, size_t error_size);
