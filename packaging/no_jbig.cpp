// Takes the place of libjbig in wheels: libtiff calls it for black-and-white pictures alone, and it is under the GNU General
// Public License. Every picture is damaged to it.
extern "C" {
void jbg_dec_init(void*) {}
int jbg_dec_in(void*, unsigned char*, unsigned long, unsigned long*) { return 1; }
unsigned char* jbg_dec_getimage(const void*, int) { return nullptr; }
unsigned long jbg_dec_getsize(const void*) { return 0; }
void jbg_dec_free(void*) {}
int jbg_newlen(unsigned char*, unsigned long) { return 1; }
const char* jbg_strerror(int) { return "JBIG is not supported"; }
void jbg_enc_init(void*, unsigned long, unsigned long, int, unsigned char**, void (*)(unsigned char*, unsigned long, void*), void*) {}
void jbg_enc_out(void*) {}
void jbg_enc_free(void*) {}
}
