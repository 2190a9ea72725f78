#pragma once

#ifdef _WIN32
#define NPLC_FMI_EXPORT __declspec(dllexport)
#else
#define NPLC_FMI_EXPORT [[gnu::visibility("default")]]
#endif
