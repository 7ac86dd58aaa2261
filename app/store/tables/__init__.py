"""The tables of the studio's database: a row is a value or a marked damage."""
