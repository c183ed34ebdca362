"""Where the power goes, why, and how it looks: built on `Results`, which know nothing of it."""
