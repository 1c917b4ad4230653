/* Counts, for each instruction of an emulated Cortex-M, how often it was executed and how often what came next was not the
 * instruction behind it. profiler.py compiles this for QEMU's plugin interface and reads the counts.
 *
 *   -plugin file=…,out=FILE[,toggle=ADDRESS]…
 *
 * Counting begins or ends behind each instruction that is a toggle; without any, all counts.
 * Writes a line an instruction: address, executed, jumped.
 *
 * Debian has no package with qemu-plugin.h; these are the few functions that are used, as QEMU's manual describes them.
 */
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef uint64_t qemu_plugin_id_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
enum { NO_REGISTERS };

size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *);
struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *, size_t);
uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn *);
const void *qemu_plugin_insn_data(const struct qemu_plugin_insn *);
void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t, void (*)(qemu_plugin_id_t, struct qemu_plugin_tb *));
void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn *, void (*)(unsigned, void *), int, void *);
void qemu_plugin_register_atexit_cb(qemu_plugin_id_t, void (*)(qemu_plugin_id_t, void *), void *);

/* The interface's version, which QEMU checks. */
#ifndef INTERFACE
#define INTERFACE 1
#endif
__attribute__((visibility("default"))) int qemu_plugin_version = INTERFACE;

enum { MAX_TOGGLES = 64, SPAN = 1 << 20 };

struct instruction {
    uint64_t address, behind, executed, jumped;
};

static const char *out;
static uint64_t toggles[MAX_TOGGLES];
static int toggle_count;
static bool counting;
static struct instruction *last;
/* Instructions by half word from the lowest address of a megabyte, where the code is. */
static struct instruction *known[SPAN / 2];
static uint64_t base = UINT64_MAX;

static bool is_toggle(uint64_t address)
{
    for (int i = 0; i < toggle_count; i++)
        if (toggles[i] == address)
            return true;
    return false;
}

/* QEMU's own figure counts what it peeks at before the end of a page. */
static uint64_t thumb_size(const struct qemu_plugin_insn *insn)
{
    const uint8_t *bytes = qemu_plugin_insn_data(insn);
    return bytes[1] >= 0xE8 ? 4 : 2;
}

static void executed(unsigned core, void *data)
{
    struct instruction *now = data;
    if (core != 0)
        return;
    if (counting) {
        now->executed++;
        if (last && last->behind != now->address)
            last->jumped++;
        last = now;
    }
}

static void toggled(unsigned core, void *data)
{
    (void)data;
    if (core == 0) {
        counting = !counting;
        last = NULL;
    }
}

static void translated(qemu_plugin_id_t id, struct qemu_plugin_tb *block)
{
    (void)id;
    for (size_t i = 0; i < qemu_plugin_tb_n_insns(block); i++) {
        struct qemu_plugin_insn *insn = qemu_plugin_tb_get_insn(block, i);
        uint64_t address = qemu_plugin_insn_vaddr(insn);
        if (base == UINT64_MAX)
            base = address & ~(uint64_t)(SPAN - 1);
        if (address - base >= SPAN) {
            fprintf(stderr, "profiler: code at %#llx is out of reach\n", (unsigned long long)address);
            exit(1);
        }
        /* The same instruction is translated again in other blocks. */
        struct instruction **place = &known[(address - base) / 2];
        if (!*place) {
            *place = calloc(1, sizeof **place);
            (*place)->address = address;
            (*place)->behind = address + thumb_size(insn);
        }
        qemu_plugin_register_vcpu_insn_exec_cb(insn, executed, NO_REGISTERS, *place);
        if (is_toggle(address))
            qemu_plugin_register_vcpu_insn_exec_cb(insn, toggled, NO_REGISTERS, NULL);
    }
}

static void ended(qemu_plugin_id_t id, void *data)
{
    (void)id, (void)data;
    FILE *file = fopen(out, "w");
    if (!file) {
        perror(out);
        return;
    }
    for (size_t i = 0; i < SPAN / 2; i++)
        if (known[i] && known[i]->executed)
            fprintf(file, "%llx %llu %llu\n", (unsigned long long)known[i]->address,
                    (unsigned long long)known[i]->executed, (unsigned long long)known[i]->jumped);
    fclose(file);
}

__attribute__((visibility("default"))) int qemu_plugin_install(qemu_plugin_id_t id, const void *info, int count,
                                                               char **arguments)
{
    (void)info;
    for (int i = 0; i < count; i++) {
        if (!strncmp(arguments[i], "out=", 4)) {
            out = strdup(arguments[i] + 4);
        } else if (!strncmp(arguments[i], "toggle=", 7) && toggle_count < MAX_TOGGLES) {
            toggles[toggle_count++] = strtoull(arguments[i] + 7, NULL, 0);
        } else {
            fprintf(stderr, "profiler: what is %s?\n", arguments[i]);
            return 1;
        }
    }
    if (!out) {
        fprintf(stderr, "profiler: say out=FILE\n");
        return 1;
    }
    counting = !toggle_count;
    qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
    qemu_plugin_register_atexit_cb(id, ended, NULL);
    return 0;
}
