/* Runs the library of an FMU as an importer in C does and prints what its outputs are, bit by bit.

   usage: fmu_driver LIBRARY TOKEN RESOURCES */
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>
static void* load(const char* path) { return (void*)LoadLibraryA(path); }
static void* find(void* library, const char* name) { return (void*)GetProcAddress((HMODULE)library, name); }
#else
#include <dlfcn.h>
static void* load(const char* path) { return dlopen(path, RTLD_NOW | RTLD_LOCAL); }
static void* find(void* library, const char* name) { return dlsym(library, name); }
#endif

typedef void (*LogFunction)(void*, int, const char*, const char*);
typedef void* (*InstantiateFunction)(const char*, const char*, const char*, bool, bool, bool, bool, const uint32_t*, size_t, void*, LogFunction, void*);
typedef int (*EnterInitializationFunction)(void*, bool, double, double, bool, double);
typedef int (*SimpleFunction)(void*);
typedef int (*SetBooleanFunction)(void*, const uint32_t*, size_t, const bool*, size_t);
typedef int (*SetFloat64Function)(void*, const uint32_t*, size_t, const double*, size_t);
typedef int (*GetFloat64Function)(void*, const uint32_t*, size_t, double*, size_t);
typedef int (*GetInt32Function)(void*, const uint32_t*, size_t, int32_t*, size_t);
typedef int (*DoStepFunction)(void*, double, double, bool, bool*, bool*, bool*, double*);
typedef int (*GetStateFunction)(void*, void**);
typedef int (*SetStateFunction)(void*, void*);

static void say(void* environment, int status, const char* category, const char* message) {
    (void)environment;
    printf("%d %s: %s\n", status, category, message);
}

#define FUNCTION(type, name) type name = (type)find(library, "fmi3" #name)

int main(int count, char** words) {
    if (count != 4) return 2;
    void* library = load(words[1]);
    if (!library) return printf("the library cannot be loaded\n"), 1;
    FUNCTION(InstantiateFunction, InstantiateCoSimulation);
    FUNCTION(EnterInitializationFunction, EnterInitializationMode);
    FUNCTION(SimpleFunction, ExitInitializationMode);
    FUNCTION(SetBooleanFunction, SetBoolean);
    FUNCTION(SetFloat64Function, SetFloat64);
    FUNCTION(GetFloat64Function, GetFloat64);
    FUNCTION(GetInt32Function, GetInt32);
    FUNCTION(DoStepFunction, DoStep);
    FUNCTION(GetStateFunction, GetFMUState);
    FUNCTION(SetStateFunction, SetFMUState);
    if (InstantiateCoSimulation("x", "{no}", words[3], 0, 0, 0, 0, NULL, 0, NULL, say, NULL)) return 1;
    void* one = InstantiateCoSimulation("x", words[2], words[3], 0, 0, 0, 0, NULL, 0, NULL, say, NULL);
    if (!one || EnterInitializationMode(one, 0, 0, 0, 0, 0) || ExitInitializationMode(one)) return 1;
    double now = 0;
    void* state = NULL;
    for (int ms = 0; ms < 1500; ++ms) {
        const uint32_t in0 = 1, load_torque = 10, reals[] = {40, 41, 42}, integers[] = {43, 44, 54, 55};
        const bool on = ms < 250;
        const double load = 0.25;
        double values[3], reached;
        int32_t numbers[4];
        bool flag;
        if ((ms == 200 || ms == 250) && SetBoolean(one, &in0, 1, &on, 1)) return 1;
        if (ms == 600 && SetFloat64(one, &load_torque, 1, &load, 1)) return 1;
        /* every hundredth step is done twice */
        if (ms % 100 == 0) {
            if (GetFMUState(one, &state) || DoStep(one, now, 0.02, 0, &flag, &flag, &flag, &reached) || SetFMUState(one, state)) return 1;
        }
        if (DoStep(one, now, 1e-3, 0, &flag, &flag, &flag, &now)) return 1;
        if (GetFloat64(one, reals, 3, values, 3) || GetInt32(one, integers, 4, numbers, 4)) return 1;
        for (int i = 0; i < 3; ++i) {
            uint32_t bits[2];
            memcpy(bits, &values[i], sizeof bits);
            printf("%08x%08x ", (unsigned)bits[1], (unsigned)bits[0]);
        }
        printf("%d %d %d %d\n", (int)numbers[0], (int)numbers[1], (int)numbers[2], (int)numbers[3]);
    }
    return 0;
}
